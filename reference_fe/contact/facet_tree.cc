#include "reference_fe/contact/facet_tree.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace pelvireg::reference_fe
{
namespace
{
constexpr int leaf_size = 4;
}

FacetTree::FacetTree(const Eigen::Matrix3Xd &points, const std::vector<std::array<int, 3>> &facets)
    : boxes_(facets.size()), order_(facets.size())
{
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const int v : facets[f])
      boxes_[f].extend(points.col(v));
  std::iota(order_.begin(), order_.end(), 0);
  if (!facets.empty())
    build(0, static_cast<int>(facets.size()));
}

int FacetTree::build(int first, int count)
{
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box;
  for (int i = first; i < first + count; ++i)
    box.extend(boxes_[order_[i]]);
  nodes_[index].box = box;
  if (count <= leaf_size)
  {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return index;
  }
  int axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](int a, int b)
                   {
                     return std::tuple(boxes_[a].center()[axis], a) < std::tuple(boxes_[b].center()[axis], b);
                   });
  const int left = build(first, count / 2);
  const int right = build(first + count / 2, count - count / 2);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

void FacetTree::candidates(const Eigen::Vector3d &point, double distance, std::vector<int> &facets) const
{
  facets.clear();
  if (nodes_.empty())
    return;
  std::array<int, 64> stack; // a median tree of 2^31 facets is 30 deep
  int n = 0;
  stack[n++] = 0;
  while (n > 0)
  {
    const Node &node = nodes_[stack[--n]];
    if (node.box.squaredExteriorDistance(point) > distance * distance)
      continue;
    if (node.left >= 0)
    {
      stack[n++] = node.right;
      stack[n++] = node.left;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i)
      if (boxes_[order_[i]].squaredExteriorDistance(point) <= distance * distance)
        facets.push_back(order_[i]);
  }
  std::sort(facets.begin(), facets.end());
}
} // namespace pelvireg::reference_fe
