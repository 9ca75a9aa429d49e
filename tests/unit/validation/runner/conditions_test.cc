#include "validation/runner/conditions.h"

#include "synthetic/dataset/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pelvireg::runner
{
namespace
{
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Bodies and attachments of the pelvis by name: two organs, a grid of ligaments, a grid of fascia.
dataset::RegistrationModel pelvis()
{
  dataset::RegistrationModel model;
  for (const char *name : {"vagina", "uterus", "fascia_sacrum", "ligaments"})
  {
    model.bodies.emplace_back();
    model.bodies.back().name = name;
  }
  model.bodies[0].outer_triangles.resize(1, 3);
  model.bodies[1].outer_triangles.resize(1, 3);
  model.attachments = {{"cardinal_left", "ligament", "ligaments", {}, "uterus"},
                       {"paravaginal_left", "ligament", "ligaments", {}, "vagina"},
                       {"fascia_sacrum", "fascia", "fascia_sacrum", {}, "vagina"},
                       {"uterus_vagina", "organ", "uterus", {}, "vagina"}};
  return model;
}

template <typename Parts> std::vector<std::string> names_of(const Parts &parts)
{
  std::vector<std::string> names;
  for (const auto &part : parts)
    names.push_back(part.name);
  return names;
}

TEST(Conditions, TakeAwayWhatTheirNameSaysAndNothingElse)
{
  const auto attachments = [](const std::string &condition)
  { return names_of(model_of(condition, pelvis()).attachments); };
  EXPECT_THAT(attachments("no_ligaments"), ElementsAre("fascia_sacrum", "uterus_vagina"));
  EXPECT_THAT(attachments("no_fascia"), ElementsAre("cardinal_left", "paravaginal_left", "uterus_vagina"));
  EXPECT_THAT(attachments("no_uterus_attachment"), ElementsAre("cardinal_left", "paravaginal_left", "fascia_sacrum"));
  for (const char *condition : {"full", "no_contact", "no_friction"})
    EXPECT_EQ(attachments(condition), names_of(pelvis().attachments)) << condition;
}

TEST(Conditions, DropGridsThatHoldNothingAndKeepEveryOrgan)
{
  const auto bodies = [](const std::string &condition) { return names_of(model_of(condition, pelvis()).bodies); };
  EXPECT_THAT(bodies("no_ligaments"), ElementsAre("vagina", "uterus", "fascia_sacrum"));
  EXPECT_THAT(bodies("no_fascia"), ElementsAre("vagina", "uterus", "ligaments"));
  EXPECT_THAT(bodies("no_uterus_attachment"), ElementsAre("vagina", "uterus", "fascia_sacrum", "ligaments"));
}

TEST(Conditions, ChooseTheRegistrationsOptions)
{
  dataset::Anatomy anatomy;
  anatomy.registration_time_step = 0.004;
  anatomy.registration_friction = 0.7;
  for (const std::string &condition : condition_names())
  {
    const registration::Options options = options_of(condition, anatomy);
    const bool is_bare = condition == "no_boundary_conditions";
    EXPECT_EQ(options.time_step, 0.004) << condition;
    EXPECT_EQ(options.use_attachments, !is_bare) << condition;
    EXPECT_EQ(options.use_contact, !is_bare && condition != "no_contact") << condition;
    EXPECT_EQ(options.friction_coefficient, condition == "no_friction" ? 0 : 0.7) << condition;
  }
}

TEST(Conditions, RefuseToTakeAwayWhatIsNotThere)
{
  dataset::RegistrationModel model = pelvis();
  model.attachments.pop_back();
  try
  {
    model_of("no_uterus_attachment", model);
    FAIL() << "no refusal";
  }
  catch (const InputError &error)
  {
    EXPECT_THAT(error.what(), HasSubstr("'no_uterus_attachment' has nothing to take away"));
  }
}

TEST(Conditions, AreNamedWhenOneIsUnknown)
{
  try
  {
    require_known_condition("no_gravity");
    FAIL() << "no refusal";
  }
  catch (const InputError &error)
  {
    EXPECT_THAT(error.what(),
                HasSubstr("'no_gravity' is unknown, allowed are: full, no_boundary_conditions, no_contact, "
                          "no_friction, no_ligaments, no_fascia, no_uterus_attachment"));
  }
}
} // namespace
} // namespace pelvireg::runner
