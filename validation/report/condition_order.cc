#include "validation/report/condition_order.h"

#include "validation/report/html.h"

#include <algorithm>

namespace pelvireg::report
{
namespace
{
const std::vector<std::string> main_conditions = {"full", "no_boundary_conditions", runner::unregistered};
}

std::string condition_title(const std::string &condition)
{
  if (condition == "full")
    return "full: with boundary conditions";
  if (condition == "no_boundary_conditions")
    return "without boundary conditions";
  if (condition == runner::unregistered)
    return "unregistered: the rest mesh";
  return condition;
}

bool is_main_condition(const std::string &condition)
{
  return std::find(main_conditions.begin(), main_conditions.end(), condition) != main_conditions.end();
}

std::vector<std::string> reading_order(const runner::Evaluation &evaluation)
{
  std::vector<std::string> order = evaluation.conditions;
  std::stable_sort(order.begin(), order.end(),
                   [](const std::string &a, const std::string &b)
                   {
                     const auto place = [](const std::string &name)
                     { return std::find(main_conditions.begin(), main_conditions.end(), name); };
                     return place(a) < place(b);
                   });
  return order;
}

std::string by_condition(const runner::Evaluation &evaluation,
                         const std::function<std::string(const std::string &)> &piece, const std::string &others)
{
  std::string seen, closed;
  for (const std::string &condition : reading_order(evaluation))
    (is_main_condition(condition) ? seen : closed) += piece(condition);
  return closed.empty() ? seen : seen + details(others, closed);
}
} // namespace pelvireg::report
