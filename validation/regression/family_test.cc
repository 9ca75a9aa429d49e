#include "validation/regression/family_test.h"

#include "validation/regression/paired_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace pelvireg::regression
{
namespace
{
std::string percent(double log_ratio)
{
  return fmt::format("{:+.2f} %", 100 * std::expm1(log_ratio));
}

/// The judgement of one family as it grows.
class FamilyTest
{
public:
  FamilyTest(FamilyComparison &result, const PairedCurves &paired, TestContext &context)
      : result_(result), paired_(paired), context_(context), rule_(context.rule)
  {
    for (std::size_t run = 0; run < paired.samples.size(); ++run)
      if (paired.samples[run] != 0)
        runs_.push_back(run);
  }

  void test_control()
  {
    describe_points();
    for (const ComparedPoint &point : result_.points)
      if (!(std::abs(point.current - point.baseline) <=
            rule_.control_absolute_mm + rule_.control_relative * point.baseline))
        return verdict(Verdict::incomparable,
                       fmt::format("doing nothing gives {:.4g} mm at {} {}, gave {:.4g}: the truth or the judge has "
                                   "changed",
                                   point.current, to_string(result_.name.axis), point.abscissa, point.baseline));
  }

  void test_registered()
  {
    if (static_cast<int>(runs_.size()) < rule_.least_samples)
      return verdict(Verdict::incomparable, fmt::format("{} randomised runs, at least {} are needed: give --samples",
                                                        runs_.size(), rule_.least_samples));
    result_.average = test_bounds(average, rule_.average_line, "average error");
    result_.tail = test_bounds(largest_p95, rule_.tail_line, "largest 95th percentile");
    test_nominal(average, rule_.average_line, "average error");
    test_nominal(largest_p95, rule_.tail_line, "largest 95th percentile");
    test_band();
    test_ceiling();
    for (const int slice : paired_.lost)
      verdict(Verdict::worse, fmt::format("slice {} no longer meets the organ in some run", slice));
    describe_points();
    if (result_.average->upper < -std::log(rule_.average_line) && result_.verdict == Verdict::pass)
      verdict(Verdict::improved, "average error " + percent(result_.average->mean));
    for (const int slice : paired_.lost_grazing)
      verdict(Verdict::changed, fmt::format("slice {}, which grazes the organ, is missed by some run", slice));
  }

  void verdict(Verdict found, const std::string &reason)
  {
    result_.verdict = std::max(result_.verdict, found);
    result_.reasons.push_back(reason);
  }

private:
  using Summary = double (*)(const PickedCurve &);

  double log_ratio(double before, double now) const
  {
    return std::log((now + rule_.floor_mm) / (before + rule_.floor_mm));
  }

  double log_ratio(Summary summary, std::size_t run) const
  {
    return log_ratio(summary(paired_.baseline[run]), summary(paired_.current[run]));
  }

  MeanBounds bounds_of(Summary summary, double level) const
  {
    std::vector<double> ratios;
    for (const std::size_t run : runs_)
      ratios.push_back(log_ratio(summary, run));
    return mean_bounds(ratios, level);
  }

  /// Three states: proven below the line; not so, and proven above no change; neither. What every family must keep is
  /// proven one by one, what a single family is enough for at a level that they share.
  MeanBounds test_bounds(Summary summary, double line, const std::string &what)
  {
    const MeanBounds bounds = bounds_of(summary, rule_.level);
    if (bounds.upper < std::log(line))
    {
      if (bounds.lower > 0 && !(bounds.mean < std::log(rule_.average_warning)))
        result_.warnings.push_back(what + " " + percent(bounds.mean) + ": proven worse, within the margin");
    }
    else if (bounds_of(summary, context_.band_level).lower > 0)
      verdict(Verdict::worse, fmt::format("{} {} ({} to {}), line {}", what, percent(bounds.mean),
                                          percent(bounds.lower), percent(bounds.upper), percent(std::log(line))));
    else
    {
      const double needed = std::ceil(std::pow(5.42 * bounds.sd / std::log(line), 2));
      verdict(Verdict::incomparable,
              fmt::format("{} {} to {}: {} runs cannot tell, about {:.0f} would", what, percent(bounds.lower),
                          percent(bounds.upper), bounds.n, std::max(needed, bounds.n + 1.0)));
    }
    return bounds;
  }

  /// A single run may lie above the line when the others scatter so much that one of them would.
  void test_nominal(Summary summary, double line, const std::string &what)
  {
    const double ratio = log_ratio(summary, 0);
    const MeanBounds bounds = bounds_of(summary, context_.band_level);
    const double reach = (bounds.upper - bounds.mean) * std::sqrt(bounds.n + 1.0); // where one more run may lie
    if (!(ratio < std::log(line)) && !(ratio <= bounds.mean + reach && bounds.sd > 0))
      verdict(Verdict::worse,
              fmt::format("nominal run: {} {}, line {}", what, percent(ratio), percent(std::log(line))));
  }

  void test_band()
  {
    const auto n_runs = static_cast<Eigen::Index>(runs_.size()),
               n = static_cast<Eigen::Index>(paired_.abscissae.size());
    Eigen::MatrixXd ratios(n_runs, n);
    Eigen::VectorXd growth = Eigen::VectorXd::Zero(n); // mm
    for (Eigen::Index r = 0; r < n_runs; ++r)
      for (Eigen::Index i = 0; i < n; ++i)
      {
        const std::size_t run = runs_[static_cast<std::size_t>(r)];
        const double before = paired_.baseline[run][static_cast<std::size_t>(i)]->mean,
                     now = paired_.current[run][static_cast<std::size_t>(i)]->mean;
        ratios(r, i) = log_ratio(before, now);
        growth[i] += (now - before) / static_cast<double>(n_runs);
      }
    band_ = simultaneous_band(ratios, context_.shares(static_cast<int>(n_runs)), context_.band_level);
    Eigen::Index worst = 0;
    bool is_over = false;
    for (Eigen::Index i = 0; i < n; ++i)
    {
      const bool is_within = band_.lower[i] <= std::log(rule_.local_line) || growth[i] <= rule_.local_least_mm;
      if (!is_within && (!is_over || band_.lower[i] > band_.lower[worst]))
        worst = i;
      is_over = is_over || !is_within;
    }
    if (is_over)
      verdict(Verdict::worse,
              fmt::format("{} {}: {} (at least {}), line {}", to_string(result_.name.axis),
                          paired_.abscissae[static_cast<std::size_t>(worst)], percent(band_.mean[worst]),
                          percent(band_.lower[worst]), percent(std::log(rule_.local_line))));
  }

  void test_ceiling()
  {
    if (result_.name.condition != "full" || result_.name.axis != Axis::step)
      return;
    double before = 0, now = 0;
    for (std::size_t run = 0; run < paired_.samples.size(); ++run)
      for (std::size_t i = 0; i < paired_.abscissae.size(); ++i)
      {
        before = std::max(before, paired_.baseline[run][i]->mean);
        now = std::max(now, paired_.current[run][i]->mean);
      }
    if (now < rule_.ceiling_mm)
      return;
    const std::string words = fmt::format("{:.2f} mm, ceiling {:g} mm", now, rule_.ceiling_mm);
    if (before < rule_.ceiling_mm)
      verdict(Verdict::worse, words);
    else
      result_.warnings.push_back(words + "; the baseline is above it too");
  }

  void describe_points()
  {
    const std::vector<std::size_t> runs = runs_.empty() ? std::vector<std::size_t>{0} : runs_;
    const auto mean_and_sd = [&](const std::vector<PickedCurve> &side, std::size_t i)
    {
      double mean = 0, squares = 0;
      for (const std::size_t run : runs)
        mean += side[run][i]->mean / static_cast<double>(runs.size());
      for (const std::size_t run : runs)
        squares += std::pow(side[run][i]->mean - mean, 2);
      return std::pair(mean, runs.size() > 1 ? std::sqrt(squares / static_cast<double>(runs.size() - 1)) : 0.0);
    };
    for (std::size_t i = 0; i < paired_.abscissae.size(); ++i)
    {
      ComparedPoint point{.abscissa = paired_.abscissae[i]};
      std::tie(point.baseline, point.baseline_sd) = mean_and_sd(paired_.baseline, i);
      std::tie(point.current, point.current_sd) = mean_and_sd(paired_.current, i);
      const auto index = static_cast<Eigen::Index>(i);
      const bool has_band = band_.mean.size() > 0;
      point.ratio = has_band ? std::exp(band_.mean[index]) : std::exp(log_ratio(point.baseline, point.current));
      point.ratio_lower = has_band ? std::exp(band_.lower[index]) : point.ratio;
      point.ratio_upper = has_band ? std::exp(band_.upper[index]) : point.ratio;
      result_.points.push_back(point);
    }
    describe_averages(runs);
  }

  void describe_averages(const std::vector<std::size_t> &runs)
  {
    const auto n = static_cast<Eigen::Index>(runs.size());
    Eigen::ArrayXd before(n), now(n);
    for (Eigen::Index r = 0; r < n; ++r)
    {
      before[r] = average(paired_.baseline[runs[static_cast<std::size_t>(r)]]);
      now[r] = average(paired_.current[runs[static_cast<std::size_t>(r)]]);
    }
    result_.baseline_mean = before.mean();
    result_.current_mean = now.mean();
    const double scale = std::sqrt((before - before.mean()).square().sum() * (now - now.mean()).square().sum());
    if (scale > 0)
      result_.pairing_correlation = ((before - before.mean()) * (now - now.mean())).sum() / scale;
  }

  FamilyComparison &result_;
  const PairedCurves &paired_;
  TestContext &context_;
  const Rule &rule_;
  std::vector<std::size_t> runs_; ///< places of the randomised runs
  Band band_;
};
} // namespace

const Eigen::MatrixXd &TestContext::shares(int n_runs)
{
  const auto found = shares_.find(n_runs);
  if (found != shares_.end())
    return found->second;
  return shares_.emplace(n_runs, bootstrap_shares(n_runs, rule.n_resamples, rule.seed)).first->second;
}

FamilyComparison test_family(const FamilyName &name, const Family &baseline, const Family &current,
                             TestContext &context)
{
  FamilyComparison result;
  result.name = name;
  PairedCurves paired;
  std::string problem = pairing_problem(name, baseline, current);
  if (problem.empty())
  {
    paired = pair_up(baseline, current, context.rule);
    problem = place_problem(paired, context.rule);
  }
  FamilyTest test(result, paired, context);
  if (!problem.empty())
  {
    test.verdict(Verdict::incomparable, problem);
    return result;
  }
  if (name.condition == "unregistered")
    test.test_control();
  else
    test.test_registered();
  const Change change = change_of(paired, context.rule);
  result.largest_change = change.largest;
  if (!change.is_none && result.verdict == Verdict::pass)
    test.verdict(Verdict::changed, fmt::format("numbers differ by up to {:.2g} %", 100 * result.largest_change));
  return result;
}
} // namespace pelvireg::regression
