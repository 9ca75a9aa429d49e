// Dense kernels of one instruction set. Included once by each kernels_*.cc inside its own namespace, which defines
// `lanes`, the number of doubles in a register. No standard header here: an inline function compiled for one
// instruction set must not be picked by the linker for all.

using Vector = double __attribute__((vector_size(lanes * sizeof(double)), may_alias));
constexpr int parts = width / lanes;               // registers for a group of rows
constexpr int most_groups = lanes == 8 ? 3 : 1;    // of rows in a tile of products
constexpr int most_columns = lanes >= 4 ? 6 : 3;   // in a tile of products
constexpr int square_columns = lanes == 8 ? 8 : 4; // in a tile of W

inline Vector load(const double *p)
{
  return *reinterpret_cast<const Vector *>(p);
}

inline void store(double *p, const Vector &v)
{
  *reinterpret_cast<Vector *>(p) = v;
}

inline double sum_of(const Vector &v)
{
  double sum = 0;
  for (int l = 0; l < lanes; ++l)
    sum += v[l];
  return sum;
}

template <int groups, int columns> struct Tile
{
  Vector value[columns][groups * parts];
};

/// sum_k a(rows, k) b(column, k). Group g of a starts at a[g]; both advance by their stride with k.
template <int groups, int columns>
inline void multiply(Tile<groups, columns> &tile, const double *const (&a)[groups], long a_stride, const double *b,
                     long b_stride, int depth)
{
  for (int c = 0; c < columns; ++c)
    for (int r = 0; r < groups * parts; ++r)
      tile.value[c][r] = Vector{};
  for (int k = 0; k < depth; ++k)
  {
    Vector rows[groups * parts];
    for (int g = 0; g < groups; ++g)
      for (int p = 0; p < parts; ++p)
        rows[g * parts + p] = load(a[g] + k * a_stride + p * lanes);
    for (int c = 0; c < columns; ++c)
    {
      const double factor = b[k * b_stride + c];
      for (int r = 0; r < groups * parts; ++r)
        tile.value[c][r] += rows[r] * factor;
    }
  }
}

/// c <- beta c - a b^T for `groups` groups of consecutive rows, beta 0 or 1.
template <int groups, int columns, bool keep>
inline void product_tile(double *c, long c_stride, const double *a, const double *b, long stride, int depth)
{
  const double *rows[groups];
  for (int g = 0; g < groups; ++g)
    rows[g] = a + g * width;
  Tile<groups, columns> tile;
  multiply(tile, rows, stride, b, stride, depth);
  for (int j = 0; j < columns; ++j)
    for (int r = 0; r < groups * parts; ++r)
    {
      double *target = c + j * c_stride + r * lanes;
      store(target, keep ? load(target) - tile.value[j][r] : -tile.value[j][r]);
    }
}

template <int columns, bool keep>
inline void product_strip(double *c, long c_stride, const double *a, const double *b, long stride, int n_groups,
                          int depth)
{
  int g = 0;
  if constexpr (most_groups == 3)
  {
    for (; n_groups - g >= 3 && n_groups - g != 4; g += 3)
      product_tile<3, columns, keep>(c + g * width, c_stride, a + g * width, b, stride, depth);
    for (; n_groups - g >= 2; g += 2)
      product_tile<2, columns, keep>(c + g * width, c_stride, a + g * width, b, stride, depth);
  }
  for (; g < n_groups; ++g)
    product_tile<1, columns, keep>(c + g * width, c_stride, a + g * width, b, stride, depth);
}

/// Cholesky of an n x n block, n <= most_columns, into `lower` (row-major).
inline bool factorise_block(const double *block, long stride, int n, double (&lower)[most_columns][most_columns],
                            double *inverse_diagonal)
{
  for (int j = 0; j < n; ++j)
  {
    double pivot = block[j * stride + j];
    for (int k = 0; k < j; ++k)
      pivot -= lower[j][k] * lower[j][k];
    if (!(pivot > 0 && pivot < __builtin_inf()))
      return false;
    lower[j][j] = __builtin_sqrt(pivot);
    inverse_diagonal[j] = 1 / lower[j][j];
    for (int i = j + 1; i < n; ++i)
    {
      double value = block[j * stride + i];
      for (int k = 0; k < j; ++k)
        value -= lower[i][k] * lower[j][k];
      lower[i][j] = value * inverse_diagonal[j];
    }
  }
  return true;
}

/// x <- x lower^-T for n_vectors registers of rows of `columns` columns.
template <int columns>
inline void solve_strip(double *x, long stride, int n_vectors, const double (&lower)[most_columns][most_columns],
                        const double *inverse_diagonal)
{
  for (int r = 0; r < n_vectors; ++r, x += lanes)
  {
    Vector value[columns];
    for (int j = 0; j < columns; ++j)
    {
      value[j] = load(x + j * stride);
      for (int k = 0; k < j; ++k)
        value[j] -= value[k] * lower[j][k];
      value[j] *= inverse_diagonal[j];
      store(x + j * stride, value[j]);
    }
  }
}

/// Columns p ... p + columns - 1 of the supernode, the earlier ones being done.
template <int columns> inline bool factorise_strip(const SupernodeColumns &node, int p)
{
  const long stride = node.stride();
  const int first_row = p / width * width;
  double *strip = node.values + p * stride;
  product_strip<columns, true>(strip + first_row, stride, node.values + first_row, node.values + p, stride,
                               static_cast<int>(stride - first_row) / width, p);
  double lower[most_columns][most_columns];
  if (!factorise_block(strip + p, stride, columns, lower, node.inverse_diagonal + p))
    return false;
  solve_strip<columns>(strip + first_row, stride, static_cast<int>(stride - first_row) / lanes, lower,
                       node.inverse_diagonal + p);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < columns; ++i)
      strip[j * stride + p + i] = i < j ? 0 : lower[i][j];
  return true;
}

inline bool factorise_columns(const SupernodeColumns &node)
{
  int p = 0;
  if constexpr (most_columns == 6)
    for (; node.n_columns - p >= 6; p += 6)
      if (!factorise_strip<6>(node, p))
        return false;
  for (; p < node.n_columns; p += 3)
    if (!factorise_strip<3>(node, p))
      return false;
  return true;
}

template <int columns> inline void update_strip(const SupernodeColumns &node, double *update, int p)
{
  const long update_stride = padded(node.n_below);
  const int first_row = p / width * width;
  product_strip<columns, false>(update + p * update_stride + first_row, update_stride, node.below() + first_row,
                                node.below() + p, node.stride(), static_cast<int>(update_stride - first_row) / width,
                                node.n_columns);
}

inline void update_matrix(const SupernodeColumns &node, double *update)
{
  int p = 0;
  if constexpr (most_columns == 6)
    for (; node.n_below - p >= 6; p += 6)
      update_strip<6>(node, update, p);
  for (; p < node.n_below; p += 3)
    update_strip<3>(node, update, p);
}

inline void extend_add(const double *update, int update_stride, const Run *runs, int first_run, int last_run,
                       int n_runs, double *target, int target_stride, int shift)
{
  for (int q = first_run; q < last_run; ++q)
    for (int j = 0; j < runs[q].length; ++j)
    {
      const double *__restrict from = update + static_cast<long>(runs[q].first + j) * update_stride;
      double *__restrict to = target + static_cast<long>(runs[q].target - shift + j) * target_stride - shift;
      for (int i = j; i < runs[q].length; ++i)
        to[runs[q].target + i] += from[runs[q].first + i];
      for (int r = q + 1; r < n_runs; ++r)
      {
        const double *__restrict source = from + runs[r].first;
        double *__restrict sum = to + runs[r].target;
        for (int i = 0; i < runs[r].length; ++i)
          sum[i] += source[i];
      }
    }
}

/// product = below x own, for `vectors` registers of rows from `first`.
template <int vectors>
inline void multiply_below(const SupernodeColumns &node, const double *own, int first, double *product)
{
  Vector sum[vectors];
  for (int r = 0; r < vectors; ++r)
    sum[r] = Vector{};
  const double *column = node.below() + first;
  for (int k = 0; k < node.n_columns; ++k, column += node.stride())
    for (int r = 0; r < vectors; ++r)
      sum[r] += load(column + r * lanes) * own[k];
  for (int r = 0; r < vectors; ++r)
    store(product + first + r * lanes, sum[r]);
}

inline void solve_lower(const SupernodeColumns &node, double *own, double *x, double *scratch)
{
  const long stride = node.stride();
  for (int j = 0; j < node.n_columns; ++j)
  {
    own[j] *= node.inverse_diagonal[j];
    const double *column = node.values + j * stride;
    for (int i = j + 1; i < node.n_columns; ++i)
      own[i] -= column[i] * own[j];
  }
  constexpr int many = 4 * width / lanes <= 8 ? 4 * width / lanes : 8;
  const int n_rows = padded(node.n_below);
  int first = 0;
  for (; n_rows - first >= many * lanes; first += many * lanes)
    multiply_below<many>(node, own, first, scratch);
  for (; first < n_rows; first += width)
    multiply_below<parts>(node, own, first, scratch);
  for (int i = 0; i < node.n_below; ++i)
    x[node.rows[i]] -= scratch[i];
}

/// own <- own - below^T x for `columns` columns from p.
template <int columns> inline void subtract_products(const SupernodeColumns &node, int p, const double *x, double *own)
{
  const long stride = node.stride();
  const double *below = node.below() + p * stride;
  const int n_rows = padded(node.n_below);
  Vector sum[columns];
  for (int c = 0; c < columns; ++c)
    sum[c] = Vector{};
  for (int r = 0; r < n_rows; r += lanes)
    for (int c = 0; c < columns; ++c)
      sum[c] += load(below + c * stride + r) * load(x + r);
  for (int c = 0; c < columns; ++c)
    own[p + c] -= sum_of(sum[c]);
}

inline void solve_upper(const SupernodeColumns &node, double *own, const double *x, double *scratch)
{
  for (int i = 0; i < node.n_below; ++i)
    scratch[i] = x[node.rows[i]];
  for (int i = node.n_below; i < padded(node.n_below); ++i)
    scratch[i] = 0;
  int p = 0;
  for (; node.n_columns - p >= 6; p += 6)
    subtract_products<6>(node, p, scratch, own);
  for (; p < node.n_columns; p += 3)
    subtract_products<3>(node, p, scratch, own);
  for (int j = node.n_columns - 1; j >= 0; --j)
  {
    const double *column = node.values + j * static_cast<long>(node.stride());
    for (int i = j + 1; i < node.n_columns; ++i)
      own[j] -= column[i] * own[i];
    own[j] *= node.inverse_diagonal[j];
  }
}
