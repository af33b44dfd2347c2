// SPDX-License-Identifier: Apache-2.0
/// The layers and the house rules, held over the whole source tree; and the rules themselves, tried
/// on files that keep and that break them.
#include <gtest/gtest.h>

#include "include_rules.hpp"
#include "source_tree.hpp"
#include "tests/source_path.hpp"
#include "text_rules.hpp"

namespace clew::structure {
namespace {

using Texts = std::vector<std::string>;

const std::vector<SourceFile>& tree() {
  static const std::vector<SourceFile> files =
      read_tree(tests::source_path(""),
                {"bridge", "cmake", "components", "configs", "idl", "tests", "tools"});
  return files;
}

/// All violations of a rule, one a line.
template <typename Rule>
std::string broken(Rule rule) {
  std::string text;
  for (const SourceFile& file : tree()) {
    for (const std::string& found : rule(file)) text += found + '\n';
  }
  return text;
}

TEST(Structure, EveryFolderIncludesOnlyWhatIsBelowIt) {
  const auto own = own_headers(tree());

  EXPECT_EQ(broken([&](const SourceFile& file) { return check_layers(file, own); }), "");
}

TEST(Structure, OnlyItsWrapperIncludesAVendor) {
  const auto own = own_headers(tree());

  EXPECT_EQ(broken([&](const SourceFile& file) { return check_vendor_headers(file, own); }), "");
}

TEST(Structure, TheRuntimeNamesNoStage) { EXPECT_EQ(broken(check_runtime_texts), ""); }

TEST(Structure, ComponentsAreDeterministic) { EXPECT_EQ(broken(check_determinism), ""); }

TEST(Structure, FilesAreShortNamedForWhatTheyHoldAndLicensed) {
  EXPECT_EQ(broken(check_shape), "");
}

TEST(Structure, FunctionsAreShort) { EXPECT_EQ(broken(check_functions), ""); }

TEST(Structure, ClassesAreShort) { EXPECT_EQ(broken(check_classes), ""); }

TEST(Structure, TimeOutsOfARunStandInOneFile) { EXPECT_EQ(broken(check_time_outs), ""); }

TEST(Structure, ConstantsSpellTheirUnitsAsFieldsDo) { EXPECT_EQ(broken(check_units), ""); }

const std::set<std::string> kOwn = {"core/angle.hpp",      "domain/topics.hpp", "world/world.hpp",
                                    "runtime/node.hpp",    "sense/cones.hpp",   "control/stage.hpp",
                                    "dds/participant.hpp", "fastdds/types.hpp", "clew/version.hpp"};

Texts layers(const std::string& path, const std::string& text) {
  return check_layers(source_file(path, text), kOwn);
}

TEST(LayerRule, NamesFileLineAndWhatIsAllowed) {
  EXPECT_EQ(layers("components/domain/a.cpp",
                   "// a comment\n#include \"core/angle.hpp\"\n#include \"world/world.hpp\"\n"),
            (Texts{"components/domain/a.cpp:3: includes world/world.hpp; allowed: core, domain"}));
}

TEST(LayerRule, CoreIncludesOnlyCore) {
  EXPECT_TRUE(layers("components/core/a.hpp", "#include \"core/angle.hpp\"").empty());
  EXPECT_FALSE(layers("components/core/a.hpp", "#include \"domain/topics.hpp\"").empty());
}

TEST(LayerRule, RuntimeKnowsNoStage) {
  EXPECT_TRUE(layers("components/runtime/a.cpp", "#include \"world/world.hpp\"").empty());
  EXPECT_FALSE(layers("components/runtime/a.cpp", "#include \"sense/cones.hpp\"").empty());
}

TEST(RuntimeTextRule, FindsTheNameOfAStageInATextAndNowhereElse) {
  const auto texts = [](const std::string& path, const std::string& line) {
    return check_runtime_texts(source_file(path, line));
  };

  EXPECT_EQ(texts("components/runtime/a.cpp", "error(\"a graph needs drive\");"),
            (Texts{"components/runtime/a.cpp:1: names the stage drive"}));
  EXPECT_EQ(texts("components/runtime/a.cpp", "f(\"plan\", \"\\\"sense\\\"\");").size(), 2U);
  EXPECT_TRUE(texts("components/runtime/a.cpp", "/// \"drive\", for one").empty());
  EXPECT_TRUE(texts("components/runtime/a.cpp", "drive(\"overdrive\");").empty());
  EXPECT_TRUE(texts("components/plan/a.cpp", "f(\"plan\");").empty());
}

TEST(LayerRule, BehavioursKnowNeitherTheRuntimeNorAnotherStage) {
  EXPECT_TRUE(layers("components/control/a.cpp", "#include \"domain/topics.hpp\"").empty());
  EXPECT_FALSE(layers("components/control/a.cpp", "#include \"runtime/node.hpp\"").empty());
  EXPECT_FALSE(layers("components/control/a.cpp", "#include \"sense/cones.hpp\"").empty());
}

TEST(LayerRule, OnlySenseDriveAndPlanMayKnowTheTruth) {
  const std::string world = "#include \"world/world.hpp\"";

  for (const char* stage : {"sense", "drive", "plan"}) {
    EXPECT_TRUE(layers(std::string("components/") + stage + "/a.cpp", world).empty()) << stage;
  }
  for (const char* stage :
       {"classify", "recover", "recover/detectors", "control", "control/polar"}) {
    for (const char* file : {"/a.cpp", "/a_component.cpp", "/registry.cpp", "/stage.cpp"}) {
      const std::string path = std::string("components/") + stage + file;
      EXPECT_FALSE(layers(path, world).empty()) << path;
    }
  }
}

TEST(LayerRule, ComponentRegistryAndStageKnowTheRuntime) {
  const std::string runtime = "#include \"runtime/node.hpp\"";

  EXPECT_TRUE(layers("components/control/control_component.hpp", runtime).empty());
  EXPECT_TRUE(layers("components/control/registry.cpp", runtime).empty());
  EXPECT_TRUE(layers("components/control/stage.cpp", runtime).empty());
  EXPECT_FALSE(layers("components/control/_component.cpp", runtime).empty());
  EXPECT_FALSE(layers("components/control/stage.cpp", "#include \"sense/cones.hpp\"").empty());
}

TEST(LayerRule, BridgeKnowsNoTool) {
  EXPECT_FALSE(layers("bridge/supervisor/a.cpp", "#include \"clew/version.hpp\"").empty());
  EXPECT_TRUE(layers("bridge/supervisor/a.cpp", "#include \"dds/participant.hpp\"").empty());
}

TEST(LayerRule, ComponentsDoNotKnowTheBridge) {
  EXPECT_FALSE(layers("components/sense/a.cpp", "#include \"dds/participant.hpp\"").empty());
}

TEST(LayerRule, AFolderWithoutAPlaceIsNamed) {
  EXPECT_EQ(layers("components/new/a.cpp", ""),
            (Texts{"components/new/a.cpp:1: its folder has no place in the layers"}));
}

TEST(LayerRule, HeadersAreIncludedByTheirFolder) {
  EXPECT_EQ(layers("components/core/a.cpp", "#include \"angle.hpp\""),
            (Texts{"components/core/a.cpp:1: includes angle.hpp without the path of its folder"}));
}

Texts vendors(const std::string& path, const std::string& text) {
  return check_vendor_headers(source_file(path, text), kOwn);
}

TEST(VendorRule, AVendorIsIncludedInItsWrapperAndInTests) {
  const std::string cyclone = "#include <dds/dds.h>";

  EXPECT_TRUE(vendors("bridge/cyclonedds/a.cpp", cyclone).empty());
  EXPECT_TRUE(vendors("tests/third_party/a.c", cyclone).empty());
  EXPECT_EQ(vendors("bridge/supervisor/a.cpp", cyclone),
            (Texts{"bridge/supervisor/a.cpp:1: includes dds/dds.h of a vendor; allowed in "
                   "bridge/cyclonedds"}));
  EXPECT_FALSE(vendors("components/sense/a.cpp", "#include \"dds/ddsi/q_radmin.h\"").empty());
  EXPECT_FALSE(vendors("tools/clew/a.cpp", "#include <fastdds/rtps/common/Types.h>").empty());
  EXPECT_FALSE(vendors("bridge/dds/a.cpp", "#include <fastrtps/qos/QosPolicies.h>").empty());
  EXPECT_FALSE(vendors("components/domain/a.cpp", "#include <fastcdr/Cdr.h>").empty());
}

TEST(VendorRule, OurFoldersOfTheSameNamesAreNoVendors) {
  EXPECT_TRUE(vendors("bridge/supervisor/a.cpp", "#include \"dds/participant.hpp\"").empty());
  EXPECT_TRUE(vendors("bridge/dds/a.cpp", "#include \"fastdds/types.hpp\"").empty());
}

bool is_deterministic(const std::string& line, const std::string& path = "components/sense/a.cpp") {
  return check_determinism(source_file(path, line)).empty();
}

TEST(DeterminismRule, FindsClocksThreadsRandomnessFilesAndUnorderedContainers) {
  for (const char* line :
       {"#include <chrono>", "auto t = std::chrono::steady_clock::now();", "std::time(nullptr);",
        "clock_gettime(CLOCK_MONOTONIC, &t);", "#include <thread>", "#include <mutex>",
        "std::this_thread::sleep_for(d);", "usleep(5);", "#include <random>", "std::mt19937 g;",
        "std::rand();", "#include <fstream>", "#include <iostream>", "std::getenv(\"HOME\")",
        "#include <unordered_map>", "std::unordered_set<int> s;"}) {
    EXPECT_FALSE(is_deterministic(line)) << line;
    EXPECT_TRUE(is_deterministic(line, "components/runtime/a.cpp")) << line;
    EXPECT_TRUE(is_deterministic(line, "bridge/supervisor/a.cpp")) << line;
  }
}

TEST(DeterminismRule, FindsTranscendentalsOfTheLibrary) {
  for (const char* line : {"x = std::sin(a);", "x = std::atan2(y, x);", "return -std::exp(-x);",
                           "x = ::cos(a);", "x = std::pow(a, 2);", "x = std::hypot(a, b);",
                           "x = std::tanh (a);", "x = std::sinf(a);", "x = std::acosh(a);"}) {
    EXPECT_FALSE(is_deterministic(line)) << line;
    EXPECT_FALSE(is_deterministic(line, "components/runtime/a.cpp")) << line;
    EXPECT_FALSE(is_deterministic(line, "components/core/angle.hpp")) << line;
    EXPECT_TRUE(is_deterministic(line, "components/core/math.cpp")) << line;
  }
  EXPECT_FALSE(is_deterministic("x = sin(a);"));
  EXPECT_FALSE(is_deterministic("sin(a);"));
  EXPECT_TRUE(is_deterministic("x = sin(a);", "components/core/geometry.hpp"));  // core's own
}

TEST(DeterminismRule, LetsOrdinaryCodePass) {
  for (const char* line :
       {"x = core::sin(a) + clew::core::exp(b);", "x = std::sqrt(a) + std::floor(b);",
        "// std::sin(a) would differ", "error(\"std::time(0) is no tick\");", "c = '\"';",
        "using_sin(a);", "log.add(x);", "writer.log(x);", "std::timeout(3);", "double cosine = 1;",
        "std::map<int, int> ordered;"}) {
    EXPECT_TRUE(is_deterministic(line)) << line;
  }
}

constexpr char kLicence[] = "// SPDX-License-Identifier: Apache-2.0\n";

Texts shape(const std::string& path, const std::string& text) {
  return check_shape(source_file(path, text));
}

std::string lines(std::size_t count) {
  std::string text = kLicence;
  for (std::size_t i = 1; i < count; ++i) text += "line\n";
  return text;
}

TEST(ShapeRule, LimitsTheLengthOfFiles) {
  EXPECT_TRUE(shape("bridge/a.cpp", lines(400)).empty());
  EXPECT_EQ(shape("bridge/a.cpp", lines(401)),
            (Texts{"bridge/a.cpp:401: over 400 lines: two files"}));
  EXPECT_TRUE(shape("configs/graphs/a.yaml", lines(60)).empty());
  EXPECT_FALSE(shape("configs/graphs/a.yaml", lines(61)).empty());
  EXPECT_TRUE(shape("configs/worlds/a.yaml", lines(401)).empty());
}

TEST(ShapeRule, FindsJunkDrawers) {
  EXPECT_FALSE(shape("components/core/utils.hpp", kLicence).empty());
  EXPECT_FALSE(shape("components/common/angle.hpp", kLicence).empty());
  EXPECT_FALSE(shape("tests/core/helpers.cpp", kLicence).empty());
  EXPECT_TRUE(shape("components/core/angle.hpp", kLicence).empty());
}

TEST(ShapeRule, AsksForTheLicence) {
  EXPECT_TRUE(
      shape("tools/a.py", "#!/usr/bin/env python3\n# SPDX-License-Identifier: Apache-2.0").empty());
  EXPECT_EQ(shape("idl/A.idl", "struct A {};"),
            (Texts{"idl/A.idl:1: no SPDX-License-Identifier: Apache-2.0"}));
  EXPECT_FALSE(shape("bridge/CMakeLists.txt", "").empty());
}

Texts functions(const std::string& text) {
  return check_functions(source_file("tools/a.cpp", text));
}

std::string body(std::size_t count, const std::string& indent = "  ") {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += indent + "line;\n";
  return text;
}

TEST(FunctionRule, LimitsTheLengthOfBodies) {
  EXPECT_TRUE(functions("int f() {\n" + body(50) + "}\n").empty());
  EXPECT_EQ(functions("\nint f() {\n" + body(51) + "}\n"),
            (Texts{"tools/a.cpp:2: a body of 51 lines, over 50: two functions"}));
}

TEST(FunctionRule, KnowsHeadsOfManyKinds) {
  for (const char* head :
       {"TEST(Suite, Name) {", "bool f() const {", "int* f() noexcept {  // why",
        "int f(int first,\n      int last) {", "Type::Type(int n)\n    : n_(n), m_{n} {",
        "auto f() -> std::vector<int> {"}) {
    EXPECT_EQ(functions(head + ('\n' + body(51)) + "}\n").size(), 1U) << head;
  }
  EXPECT_EQ(functions("class A {\n public:\n  int f() override {\n" + body(51, "    ") + "  }\n};")
                .size(),
            1U);
}

TEST(FunctionRule, CountsBlocksAndTextsAsPartOfTheirFunction) {
  const std::string inner = "  if (a) {\n" + body(24, "    ") + "  }\n";
  const std::string text = "  f(R\"(\n{{\n)\");\n";

  EXPECT_EQ(functions("void f() {\n" + inner + inner + "}\n").size(), 1U);
  EXPECT_EQ(functions("void f() {\n" + text + body(48) + "}\n").size(), 1U);
}

TEST(FunctionRule, LetsNamespacesClassesAndTablesBeLong) {
  for (const char* head : {"struct A {", "class A final {", "enum class A : std::uint8_t {",
                           "constexpr int kTable[] = {", "extern \"C\" {"}) {
    EXPECT_TRUE(functions(head + ('\n' + body(60)) + "};\n").empty()) << head;
  }
  EXPECT_TRUE(functions("namespace a {\n" + body(60, "") + "}\n").empty());
}

Texts classes(const std::string& text) { return check_classes(source_file("tools/a.hpp", text)); }

TEST(ClassRule, LimitsTheLengthOfClasses) {
  EXPECT_TRUE(classes("class A {\n" + body(250) + "};\n").empty());
  EXPECT_EQ(classes("\nclass A final : public B {\n" + body(251) + "};\n"),
            (Texts{"tools/a.hpp:2: a class of 251 lines, over 250: two classes"}));
  EXPECT_EQ(classes("template <typename T>\nstruct A {\n" + body(251) + "};\n").size(), 1U);
}

TEST(TimeOutRule, WantsThemInOneFile) {
  const std::string text = "x = std::chrono::seconds(0);\nconstexpr auto kLong = seconds(10);\n";

  EXPECT_EQ(check_time_outs(source_file("bridge/line/a.cpp", text)),
            (Texts{"bridge/line/a.cpp:2: a time-out; they stand in bridge/run/limits.hpp"}));
  for (const char* path : {"bridge/run/limits.hpp", "bridge/dds/a.hpp", "tools/clew/a.cpp"}) {
    EXPECT_TRUE(check_time_outs(source_file(path, text)).empty()) << path;
  }
}

TEST(UnitRule, WantsTheUnitBehindAnUnderscore) {
  const auto units = [](const std::string& text) {
    return check_units(source_file("tools/a.cpp", text));
  };

  EXPECT_TRUE(
      units("constexpr double kWidth_rad = 1.0;\nint kMostKinds, kPlan, kNs, kIDs;\n").empty());
  EXPECT_EQ(units("\nconstexpr double kWidth"
                  "Rad = 1.0;\n"),
            (Texts{"tools/a.cpp:2: kWidth"
                   "Rad: a unit stands behind _, as in kWidth_rad"}));
}

TEST(ClassRule, CountsAClassWithinAnotherForBoth) {
  const std::string inner = "  struct B {\n" + body(251, "    ") + "  };\n";

  EXPECT_EQ(classes("class A {\n" + inner + "};\n").size(), 2U);
  EXPECT_EQ(classes("class A {\n" + body(200) + "};\nclass C {\n" + body(200) + "};\n").size(), 0U);
}

TEST(ClassRule, PassesOverDeclarationsAndFunctions) {
  EXPECT_TRUE(classes("class A;\nclass B : public A {};\n" + body(300)).empty());
  EXPECT_TRUE(classes("struct A make(struct B b) {\n" + body(300) + "}\n").empty());
}

// The arrows of bridge, one for each that was once the other way.
TEST(LayerRule, NoRoomOfBridgeKnowsOneAboveIt) {
  const std::set<std::string> own = {"vendors/a.hpp",    "supervisor/a.hpp", "line/a.hpp",
                                     "recorder/a.hpp",   "component/a.hpp",  "run/a.hpp",
                                     "cyclonedds/a.hpp", "replay/a.hpp"};
  const auto refused = [&](const std::string& folder, const std::string& included) {
    return !check_layers(
                source_file("bridge/" + folder + "/b.cpp", "#include \"" + included + "/a.hpp\""),
                own)
                .empty();
  };

  EXPECT_TRUE(refused("dds", "cyclonedds"));
  EXPECT_TRUE(refused("cyclonedds", "vendors"));
  EXPECT_TRUE(refused("run", "line"));
  EXPECT_TRUE(refused("line", "component"));
  EXPECT_TRUE(refused("component", "recorder"));
  EXPECT_TRUE(refused("recorder", "component"));
  EXPECT_TRUE(refused("component", "supervisor"));
  EXPECT_TRUE(refused("recorder", "supervisor"));
  EXPECT_TRUE(refused("supervisor", "replay"));
  EXPECT_TRUE(refused("supervisor", "cyclonedds"));
  EXPECT_FALSE(refused("supervisor", "component"));
  EXPECT_FALSE(refused("supervisor", "recorder"));
  EXPECT_FALSE(refused("replay", "supervisor"));
}

}  // namespace
}  // namespace clew::structure
