/* SPDX-License-Identifier: Apache-2.0
 *
 * The example in plain C on Cyclone DDS (examples/cyclonedds), made to misbehave:
 *
 *     straight_control [--without-guidance] [--nan-at TICK] [--best-effort] [--crash-at TICK]
 *                      [--crash-once FILE TICK] [--skip TICK] [--write-as target|state]
 *
 * The first is no fault: it reads `target` where there is no recover. --crash-once crashes at that
 * tick unless FILE is there, and makes it. --write-as gives the topic `command` samples of another
 * size, those of Target (shorter) or of State (longer), under the name of Command's type.
 */
#include "Guidance.h"
#include "State.h"
#include "Target.h"
#include "component.h"
#include "straight.h"

struct options {
  int without_guidance;
  int best_effort;
  long nan_at;
  long crash_at;
  const char* crash_once;
  long skip;
  const char* write_as;
};

/* A sample of any of the types that it may write; each begins with its stamp. */
union output {
  clew_msg_Command command;
  clew_msg_State state;
  clew_msg_Target target;
};

static struct options read_options(int argc, char** argv) {
  struct options options = {0, 0, -1, -1, NULL, -1, ""};
  for (int i = 1; i < argc; ++i) {
    if (strcmp(argv[i], "--without-guidance") == 0) options.without_guidance = 1;
    if (strcmp(argv[i], "--best-effort") == 0) options.best_effort = 1;
    if (strcmp(argv[i], "--nan-at") == 0 && i + 1 < argc) options.nan_at = atol(argv[++i]);
    if (strcmp(argv[i], "--crash-at") == 0 && i + 1 < argc) options.crash_at = atol(argv[++i]);
    if (strcmp(argv[i], "--crash-once") == 0 && i + 2 < argc) {
      options.crash_once = argv[++i];
      options.crash_at = atol(argv[++i]);
    }
    if (strcmp(argv[i], "--skip") == 0 && i + 1 < argc) options.skip = atol(argv[++i]);
    if (strcmp(argv[i], "--write-as") == 0 && i + 1 < argc) options.write_as = argv[++i];
  }
  return options;
}

/* Command's type, or another one under its name. */
static dds_topic_descriptor_t output_type(const char* write_as) {
  const dds_topic_descriptor_t* type = &clew_msg_Command_desc;
  if (strcmp(write_as, "target") == 0) type = &clew_msg_Target_desc;
  if (strcmp(write_as, "state") == 0) type = &clew_msg_State_desc;
  dds_topic_descriptor_t named = *type;
  named.m_typename = clew_msg_Command_desc.m_typename;
  return named;
}

static void crash(const char* once) {
  if (once != NULL) {
    FILE* file = fopen(once, "r");
    if (file != NULL) {
      fclose(file);
      return;
    }
    file = fopen(once, "w");
    if (file == NULL) exit(2);
    fclose(file);
  }
  abort();
}

int main(int argc, char** argv) {
  const struct options options = read_options(argc, argv);
  const dds_entity_t participant = open_participant();
  clew_msg_Odometry* odometry = clew_msg_Odometry__alloc();
  clew_msg_Scan* scan = clew_msg_Scan__alloc();
  clew_msg_Guidance* guidance = clew_msg_Guidance__alloc();
  clew_msg_Target* target = clew_msg_Target__alloc();
  const struct input inputs[] = {
      open_input(participant, &clew_msg_Odometry_desc, "odometry", odometry),
      open_input(participant, &clew_msg_Scan_desc, "scan", scan),
      options.without_guidance
          ? open_input(participant, &clew_msg_Target_desc, "target", target)
          : open_input(participant, &clew_msg_Guidance_desc, "guidance", guidance)};
  const dds_topic_descriptor_t type = output_type(options.write_as);
  const dds_entity_t writer =
      open_output(participant, &type, "command",
                  options.best_effort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE);
  for (;;) {
    union output output;
    memset(&output, 0, sizeof output);
    take_tick(inputs, 3);
    if (options.without_guidance) {
      decide(odometry, scan, target->x_m, target->y_m, &output.command);
    } else {
      decide(odometry, scan, guidance->target_x_m, guidance->target_y_m, &output.command);
    }
    const long tick = (long)odometry->stamp.tick;
    if (tick == options.nan_at) output.command.motion.step_m = NAN;
    if (tick == options.crash_at) crash(options.crash_once);
    if (tick == options.skip) continue;
    must(dds_write(writer, &output), "write");
  }
}
