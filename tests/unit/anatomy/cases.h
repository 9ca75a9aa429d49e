// The built-in cases, generated once a test program.
#pragma once

#include "synthetic/anatomy/case.h"

#include <gtest/gtest.h>

#include <map>

namespace pelvireg::test
{
inline const dataset::Anatomy &generated(const std::string &name)
{
  static std::map<std::string, dataset::Anatomy> cases;
  if (cases.count(name) == 0)
    cases[name] = anatomy::build_anatomy(anatomy::case_text(name), name);
  return cases.at(name);
}

inline const dataset::RegistrationBody &body_of(const dataset::Anatomy &anatomy, const std::string &name)
{
  for (const dataset::RegistrationBody &body : anatomy.registration.bodies)
    if (body.name == name)
      return body;
  throw std::runtime_error("no body " + name);
}

inline const dataset::ReferenceShell &shell_of(const dataset::Anatomy &anatomy, const std::string &name)
{
  for (const dataset::ReferenceShell &shell : anatomy.reference.shells)
    if (shell.name == name)
      return shell;
  throw std::runtime_error("no shell " + name);
}

/// Tests that hold for every built-in case; the parameter is its name.
class EveryCase : public testing::TestWithParam<std::string>
{
protected:
  const dataset::Anatomy &anatomy() const { return generated(GetParam()); }
};
} // namespace pelvireg::test
