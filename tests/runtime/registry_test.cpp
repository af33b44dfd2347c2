// SPDX-License-Identifier: Apache-2.0
#include "runtime/registry.hpp"

#include <gtest/gtest.h>

namespace clew::runtime {
namespace {

class Greeter {
 public:
  virtual ~Greeter() = default;
  virtual std::string greet() const = 0;
};

class Polite : public Greeter {
 public:
  struct Parameters {
    std::int64_t bows = 2;
  };
  static core::Result<std::unique_ptr<Polite>> create(const Parameters& parameters,
                                                      const domain::BehaviourSetup& setup) {
    if (setup.robot.name.empty()) return core::Error{"needs a name to greet"};
    auto greeter = std::make_unique<Polite>();
    greeter->text_ = setup.robot.name + ", " + std::to_string(parameters.bows) + " bows";
    return greeter;
  }
  std::string greet() const override { return text_; }

 private:
  std::string text_;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, Polite::Parameters& p) {
  visit.integer("bows", p.bows, "1", {0, 9}, "how many");
}

class Short : public Greeter {
 public:
  struct Parameters {};
  static core::Result<std::unique_ptr<Short>> create(const Parameters&,
                                                     const domain::BehaviourSetup&) {
    return std::make_unique<Short>();
  }
  std::string greet() const override { return "hi"; }
};

template <typename Visitor>
void visit_parameters(Visitor&, Short::Parameters&) {}

const Registry<Greeter>& greeters() {
  static const TopicSet scan = TopicSet().set(index_of(Topic::kScan));
  static const Registry<Greeter> registry = {
      registration<Greeter, Polite>("polite", "bows", scan),
      registration<Greeter, Short>("short", "says hi"),
  };
  return registry;
}

domain::BehaviourSetup setup_of(const std::string& robot) {
  domain::BehaviourSetup setup;
  setup.robot.name = robot;
  return setup;
}

TEST(Registry, ListsItsBehavioursInOrder) {
  const std::vector<VariantInfo> variants = greeters().variants();

  ASSERT_EQ(variants.size(), 2u);
  EXPECT_EQ(variants[0].name, "polite");
  EXPECT_EQ(variants[0].summary, "bows");
  ASSERT_EQ(variants[0].parameters.size(), 1u);
  EXPECT_EQ(variants[0].parameters[0].name, "bows");
  EXPECT_TRUE(variants[0].needs[index_of(Topic::kScan)]);
  EXPECT_EQ(variants[1].name, "short");
  EXPECT_TRUE(variants[1].parameters.empty());
  EXPECT_TRUE(variants[1].needs.none());
}

TEST(Registry, MakesABehaviourWithItsParametersAndSetup) {
  const auto polite = greeters().make({"polite", {{"bows", std::int64_t{3}}}}, setup_of("Ada"));
  const auto hi = greeters().make({"short", {}}, setup_of("Ada"));

  ASSERT_TRUE(polite.ok());
  EXPECT_EQ((*polite)->greet(), "Ada, 3 bows");
  ASSERT_TRUE(hi.ok());
  EXPECT_EQ((*hi)->greet(), "hi");
}

TEST(Registry, PassesOnWhyABehaviourCannotBeMade) {
  const auto made = greeters().make({"polite", {{"bows", std::int64_t{3}}}}, setup_of(""));

  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().text(), "needs a name to greet");
}

TEST(RegistryDeathTest, ANameThatTheGraphsCheckLetThroughIsOurMistake) {
  EXPECT_DEATH(static_cast<void>(greeters().make({"rude", {}}, {})),
               "behaviour 'rude' was not checked");
}

}  // namespace
}  // namespace clew::runtime
