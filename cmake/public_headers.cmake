# SPDX-License-Identifier: Apache-2.0
# The headers that are meant for others, and what those include. Used when installing, and for the
# fingerprint that a plug-in must have in common with the program that loads it.

cmake_policy(VERSION 3.25)

# What a behaviour is written against: its stage's interface, the values on the arrows, and what our
# own behaviours compute with.
set(CLEW_BEHAVIOUR_HEADERS
  core/angle.hpp core/archive.hpp core/fuzzy.hpp core/geometry.hpp core/hash128.hpp core/math.hpp
  core/parameters.hpp core/random.hpp core/result.hpp core/segment.hpp core/yaml_fields.hpp
  core/yaml_reader.hpp
  domain/infrared_curve.hpp domain/inside.hpp domain/landmark_classes.hpp domain/messages.hpp
  domain/motion_conversion.hpp domain/picture.hpp domain/setup.hpp domain/topics.hpp domain/words.hpp
  scan/nearest_return.hpp scan/safe_regions.hpp scan/scan_needs.hpp scan/seven_cones.hpp
  map/local_map.hpp map/local_path.hpp world/world.hpp
  sense/range_sensor.hpp classify/classifier.hpp plan/planner.hpp
  recover/detectors/trap_detector.hpp recover/escapes/escape.hpp
  control/controller.hpp drive/drive_model.hpp)

# What a program that runs graphs, or reads and replays recordings, is written against.
set(CLEW_PROGRAM_HEADERS
  plugin/plugin.hpp runtime/registry.hpp runtime/run_plan.hpp stages/all.hpp
  wire/codec.hpp wire/field_list.hpp recording/run_recording.hpp recorder/recording_sink.hpp
  run/composed_run.hpp
  replay/branch.hpp replay/component_replay.hpp replay/recorded_plan.hpp
  replay/recording_diff.hpp)

# clew_closure(<variable> <source tree> HEADER...): the headers and all that they include of ours,
# sorted, as `folder/name.hpp`; <variable>_PATHS has the files in the same order.
function(clew_closure variable source)
  set(found)
  set(open ${ARGN})
  while(open)
    list(POP_FRONT open header)
    if(header IN_LIST found)
      continue()
    endif()
    set(path ${source}/components/${header})
    if(NOT EXISTS ${path})
      set(path ${source}/bridge/${header})
    endif()
    if(NOT EXISTS ${path})  # generated
      continue()
    endif()
    list(APPEND found ${header})
    file(STRINGS ${path} includes REGEX "^#include \"")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
      list(APPEND open ${included})
    endforeach()
  endwhile()
  list(SORT found)
  set(paths)
  foreach(header IN LISTS found)
    if(EXISTS ${source}/components/${header})
      list(APPEND paths ${source}/components/${header})
    else()
      list(APPEND paths ${source}/bridge/${header})
    endif()
  endforeach()
  set(${variable} ${found} PARENT_SCOPE)
  set(${variable}_PATHS ${paths} PARENT_SCOPE)
endfunction()
