#include "registration/solver/supernodal_factor.h"

#include <cblas.h>
#include <cholmod.h>

#include <algorithm>
#include <stdexcept>

namespace pelvireg::registration
{
namespace
{
cholmod_sparse lower_view(int n, std::vector<int> &starts, std::vector<int> &rows, double *values)
{
  cholmod_sparse view{};
  view.nrow = view.ncol = n;
  view.nzmax = rows.size();
  view.p = starts.data();
  view.i = rows.data();
  view.x = values;
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

void quieten(cholmod_common &common)
{
  common.print = 0;
  common.error_handler = nullptr;
}
} // namespace

std::vector<int> fill_reducing_order(int n_blocks, const std::vector<std::vector<int>> &cliques)
{
  std::vector<std::vector<int>> rows_of(n_blocks);
  for (const std::vector<int> &clique : cliques)
    for (const int column : clique)
      for (const int row : clique)
        if (row >= column)
          rows_of[column].push_back(row);
  std::vector<int> starts{0}, rows;
  for (std::vector<int> &column : rows_of)
  {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows.insert(rows.end(), column.begin(), column.end());
    starts.push_back(static_cast<int>(rows.size()));
  }
  cholmod_common common;
  cholmod_start(&common);
  quieten(common);
  cholmod_sparse graph = lower_view(n_blocks, starts, rows, nullptr);
  cholmod_factor *symbolic = cholmod_analyze(&graph, &common);
  std::vector<int> order(n_blocks);
  if (symbolic)
    std::copy_n(static_cast<const int *>(symbolic->Perm), n_blocks, order.begin());
  const bool failed = symbolic == nullptr;
  cholmod_free_factor(&symbolic, &common);
  cholmod_finish(&common);
  if (failed)
    throw std::runtime_error("registration: CHOLMOD could not order a matrix of " + std::to_string(n_blocks) +
                             " nodes; the memory is exhausted or the library is broken");
  return order;
}

struct SupernodalFactor::Cholmod
{
  Cholmod()
  {
    cholmod_start(&common);
    quieten(common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0; // the order given is postordered, and the columns must stay where they are
    common.final_ll = 1;
  }
  ~Cholmod()
  {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod &) = delete;
  Cholmod &operator=(const Cholmod &) = delete;

  /// CHOLMOD takes no const pointers, but changes neither pattern nor values.
  static cholmod_sparse view(const SymmetricBlockMatrix &matrix)
  {
    return lower_view(matrix.n_rows(), const_cast<std::vector<int> &>(matrix.column_starts()),
                      const_cast<std::vector<int> &>(matrix.row_indices()),
                      const_cast<double *>(matrix.values().data()));
  }

  cholmod_common common{};
  cholmod_factor *factor = nullptr;
};

SupernodalFactor::SupernodalFactor(const SymmetricBlockMatrix &matrix)
    : cholmod_(std::make_unique<Cholmod>()), n_rows_(matrix.n_rows())
{
  cholmod_sparse view = Cholmod::view(matrix);
  cholmod_->factor = cholmod_analyze(&view, &cholmod_->common);
  if (!cholmod_->factor || !cholmod_->factor->is_super)
    throw std::runtime_error("registration: CHOLMOD could not analyse a matrix of " + std::to_string(n_rows_) +
                             " rows; the memory is exhausted or the library lacks its supernodal part");
  n_supernodes_ = static_cast<int>(cholmod_->factor->nsuper);
  supernode_of_.resize(n_rows_);
  parent_.assign(n_supernodes_, -1);
  int most_rows = 0;
  for (int s = 0; s < n_supernodes_; ++s)
  {
    const Supernode node = supernode(s);
    most_rows = std::max(most_rows, node.n_rows);
    std::fill_n(supernode_of_.begin() + node.first_column, node.n_columns, s);
  }
  for (int s = 0; s < n_supernodes_; ++s)
  {
    const Supernode node = supernode(s);
    if (node.n_rows > node.n_columns)
      parent_[s] = supernode_of_[node.rows[node.n_columns]];
  }
  gathered_.resize(most_rows);
}

SupernodalFactor::~SupernodalFactor() = default;
SupernodalFactor::SupernodalFactor(SupernodalFactor &&) noexcept = default;
SupernodalFactor &SupernodalFactor::operator=(SupernodalFactor &&) noexcept = default;

bool SupernodalFactor::factorise(const SymmetricBlockMatrix &matrix)
{
  cholmod_sparse view = Cholmod::view(matrix);
  const bool ran = cholmod_factorize(&view, cholmod_->factor, &cholmod_->common);
  return ran && cholmod_->common.status == CHOLMOD_OK && cholmod_->factor->minor == cholmod_->factor->n;
}

Supernode SupernodalFactor::supernode(int s) const
{
  const cholmod_factor &factor = *cholmod_->factor;
  const int *super = static_cast<const int *>(factor.super);
  const int *row_starts = static_cast<const int *>(factor.pi);
  const int *value_starts = static_cast<const int *>(factor.px);
  Supernode node;
  node.first_column = super[s];
  node.n_columns = super[s + 1] - super[s];
  node.n_rows = row_starts[s + 1] - row_starts[s];
  node.rows = static_cast<const int *>(factor.s) + row_starts[s];
  if (factor.xtype == CHOLMOD_REAL)
    node.values = static_cast<const double *>(factor.x) + value_starts[s];
  return node;
}

long SupernodalFactor::n_stored_values() const
{
  return static_cast<long>(cholmod_->factor->xsize);
}

void SupernodalFactor::solve(Eigen::Ref<Eigen::VectorXd> x)
{
  solve_lower(x.data());
  solve_upper(x.data());
}

void SupernodalFactor::solve_lower(double *x)
{
  for (int s = 0; s < n_supernodes_; ++s)
  {
    const Supernode node = supernode(s);
    double *top = x + node.first_column;
    cblas_dtrsv(CblasColMajor, CblasLower, CblasNoTrans, CblasNonUnit, node.n_columns, node.values, node.n_rows, top,
                1);
    const int n_below = node.n_rows - node.n_columns;
    if (n_below == 0)
      continue;
    cblas_dgemv(CblasColMajor, CblasNoTrans, n_below, node.n_columns, 1.0, node.values + node.n_columns, node.n_rows,
                top, 1, 0.0, gathered_.data(), 1);
    for (int r = 0; r < n_below; ++r)
      x[node.rows[node.n_columns + r]] -= gathered_[r];
  }
}

void SupernodalFactor::solve_upper(double *x)
{
  for (int s = n_supernodes_ - 1; s >= 0; --s)
  {
    const Supernode node = supernode(s);
    double *top = x + node.first_column;
    const int n_below = node.n_rows - node.n_columns;
    for (int r = 0; r < n_below; ++r)
      gathered_[r] = x[node.rows[node.n_columns + r]];
    if (n_below > 0)
      cblas_dgemv(CblasColMajor, CblasTrans, n_below, node.n_columns, -1.0, node.values + node.n_columns, node.n_rows,
                  gathered_.data(), 1, 1.0, top, 1);
    cblas_dtrsv(CblasColMajor, CblasLower, CblasTrans, CblasNonUnit, node.n_columns, node.values, node.n_rows, top, 1);
  }
}
} // namespace pelvireg::registration
