#include "reference_fe/materials/mooney_rivlin.h"
#include "reference_fe/materials/neo_hookean.h"
#include "reference_fe/materials/saint_venant_kirchhoff.h"
#include "reference_fe/materials/yeoh.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace pelvireg::reference_fe
{
namespace
{
struct NamedLaw
{
  std::string name;
  std::shared_ptr<const HyperelasticLaw> law;
};

class EveryLaw : public ::testing::TestWithParam<NamedLaw>
{
protected:
  const HyperelasticLaw &law() const { return *GetParam().law; }
};

INSTANTIATE_TEST_SUITE_P(, EveryLaw,
                         ::testing::Values(NamedLaw{"NeoHookean", std::make_shared<NeoHookean>(0.4, 30.0)},
                                           NamedLaw{"MooneyRivlin", std::make_shared<MooneyRivlin>(0.3, 0.2, 40.0)},
                                           NamedLaw{"Yeoh", std::make_shared<Yeoh>(0.1, 0.05, 0.02, 20.0)},
                                           NamedLaw{"SaintVenantKirchhoff",
                                                    std::make_shared<SaintVenantKirchhoff>(2.0, 0.3)}),
                         [](const auto &tested) { return tested.param.name; });

const Eigen::Matrix3d deformation_gradient =
    (Eigen::Matrix3d() << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, 0.15, -0.2, 1.1).finished();

Voigt green_lagrange(const Eigen::Matrix3d &f)
{
  const Eigen::Matrix3d e = 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
  return (Voigt() << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(0, 2), 2 * e(1, 2)).finished();
}

Eigen::Matrix3d tensor(const Voigt &s)
{
  return (Eigen::Matrix3d() << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2]).finished();
}

/// Central difference with one Richardson step: error of order h^4. `Value` is double or Voigt.
template <typename Value, typename Function> Value derivative(const Function &f, int direction)
{
  const auto central = [&](double h) -> Value
  {
    Voigt plus = green_lagrange(deformation_gradient), minus = plus;
    plus[direction] += h;
    minus[direction] -= h;
    return (f(plus) - f(minus)) / (2 * h);
  };
  const double h = 1e-3;
  return (4.0 * central(h / 2) - central(h)) / 3.0;
}

TEST_P(EveryLaw, StressIsTheDerivativeOfTheEnergy)
{
  const StressState state = law().evaluate(green_lagrange(deformation_gradient));
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(state.stress[i], derivative<double>([&](const Voigt &e) { return law().evaluate(e).energy; }, i),
                2e-9 * state.stress.norm());
}

TEST_P(EveryLaw, TangentIsTheDerivativeOfTheStress)
{
  const StressState state = law().evaluate(green_lagrange(deformation_gradient));
  for (int i = 0; i < 6; ++i)
  {
    const Voigt column = derivative<Voigt>([&](const Voigt &e) -> Voigt { return law().evaluate(e).stress; }, i);
    EXPECT_LT((state.tangent.col(i) - column).norm(), 2e-8 * state.tangent.norm());
  }
  EXPECT_EQ(state.tangent, state.tangent.transpose());
}

TEST_P(EveryLaw, RestIsFreeOfStressAndEnergy)
{
  const StressState state = law().evaluate(Voigt::Zero());
  EXPECT_LT(state.stress.norm(), 1e-14);
  EXPECT_NEAR(state.energy, 0, 1e-15);
}

TEST_P(EveryLaw, EnergyIsObjectiveAndIsotropic)
{
  const Eigen::Matrix3d q = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const StressState state = law().evaluate(green_lagrange(deformation_gradient));
  const StressState rotated = law().evaluate(green_lagrange(q * deformation_gradient));
  EXPECT_NEAR(rotated.energy, state.energy, 1e-13 * state.energy);
  // A rotated specimen: C -> Q^T C Q, S -> Q^T S Q.
  const StressState turned = law().evaluate(green_lagrange(deformation_gradient * q));
  EXPECT_NEAR(turned.energy, state.energy, 1e-13 * state.energy);
  EXPECT_LT((tensor(turned.stress) - q.transpose() * tensor(state.stress) * q).norm(), 1e-12 * state.stress.norm());
}

TEST(YeohLaw, EquibiaxialCauchyStressMatchesTheClosedFormForIncompressibility)
{
  // sigma = 2 (lambda^2 - lambda^-4) dW/dI1 (Holzapfel 2000, section 6.5); pressure taken from sigma_33 = 0.
  const double c10 = 0.1, c20 = 0.05, c30 = 0.02, lambda = 1.4;
  const Yeoh law(c10, c20, c30, 1000.0);
  const double x = 2 * lambda * lambda + std::pow(lambda, -4) - 3;
  const double closed = 2 * (lambda * lambda - std::pow(lambda, -4)) * (c10 + 2 * c20 * x + 3 * c30 * x * x);
  const Eigen::Matrix3d f = Eigen::Vector3d(lambda, lambda, 1 / (lambda * lambda)).asDiagonal();
  const Eigen::Matrix3d cauchy = f * tensor(law.evaluate(green_lagrange(f)).stress) * f.transpose();
  EXPECT_NEAR(cauchy(0, 0) - cauchy(2, 2), closed, 1e-12);
}

TEST(InvertedCell, IsNotANumber)
{
  const Voigt collapsed = (Voigt() << 0, 0, -0.6, 0, 0, 0).finished(); // C33 = -0.2
  EXPECT_TRUE(std::isnan(NeoHookean(1, 10).evaluate(collapsed).energy));
}
} // namespace
} // namespace pelvireg::reference_fe
