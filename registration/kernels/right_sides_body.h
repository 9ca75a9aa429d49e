// Kernels for many right-hand sides, of one instruction set; see dense_body.h.

template <int groups> inline void pointers_to(const double *(&result)[groups], const RightSides &sides, int g, long at)
{
  for (int i = 0; i < groups; ++i)
    result[i] = sides.values[sides.groups[g + i]] + at * width;
}

/// The supernode's own unknowns p ... p + columns - 1, the earlier ones being done.
template <int groups, int columns>
inline void solve_own(const SupernodeColumns &node, int first, const RightSides &sides, int g, int p)
{
  const long stride = node.stride();
  const double *done[groups];
  pointers_to(done, sides, g, first);
  Tile<groups, columns> tile;
  multiply(tile, done, width, node.values + p, stride, p);
  for (int i = 0; i < groups; ++i)
    for (int part = 0; part < parts; ++part)
    {
      double *own = sides.values[sides.groups[g + i]] + static_cast<long>(first + p) * width + part * lanes;
      Vector value[columns];
      for (int j = 0; j < columns; ++j)
      {
        value[j] = load(own + j * width) - tile.value[j][i * parts + part];
        for (int k = 0; k < j; ++k)
          value[j] -= value[k] * node.values[(p + k) * stride + p + j];
        value[j] *= node.inverse_diagonal[p + j];
        store(own + j * width, value[j]);
      }
    }
}

template <int groups, int columns>
inline void subtract_below(const SupernodeColumns &node, int first, const RightSides &sides, int g, int row)
{
  const double *own[groups];
  pointers_to(own, sides, g, first);
  Tile<groups, columns> tile;
  multiply(tile, own, width, node.below() + row, node.stride(), node.n_columns);
  for (int i = 0; i < groups; ++i)
    for (int j = 0; j < columns; ++j)
    {
      double *target = sides.values[sides.groups[g + i]] + static_cast<long>(node.rows[row + j]) * width;
      for (int part = 0; part < parts; ++part)
        store(target + part * lanes, load(target + part * lanes) - tile.value[j][i * parts + part]);
    }
}

template <int groups>
inline void eliminate_groups(const SupernodeColumns &node, int first, const RightSides &sides, int g)
{
  int p = 0;
  if constexpr (most_columns == 6)
    for (; node.n_columns - p >= 6; p += 6)
      solve_own<groups, 6>(node, first, sides, g, p);
  for (; p < node.n_columns; p += 3)
    solve_own<groups, 3>(node, first, sides, g, p);
  int row = 0;
  if constexpr (most_columns == 6)
    for (; node.n_below - row >= 6; row += 6)
      subtract_below<groups, 6>(node, first, sides, g, row);
  for (; row < node.n_below; row += 3)
    subtract_below<groups, 3>(node, first, sides, g, row);
}

inline void eliminate(const SupernodeColumns &node, int first, const RightSides &sides)
{
  int g = 0;
  if constexpr (most_groups == 3)
  {
    for (; sides.n_groups - g >= 3 && sides.n_groups - g != 4; g += 3)
      eliminate_groups<3>(node, first, sides, g);
    for (; sides.n_groups - g >= 2; g += 2)
      eliminate_groups<2>(node, first, sides, g);
  }
  for (; g < sides.n_groups; ++g)
    eliminate_groups<1>(node, first, sides, g);
}

/// Tiles (g ... g + groups - 1, j) of the products.
template <int groups>
inline void square_tiles(int first, int n_columns, const RightSides &sides, int g, int j, double *products)
{
  const double *rows[groups];
  pointers_to(rows, sides, g, first);
  const double *columns = sides.values[sides.groups[j]] + static_cast<long>(first) * width;
  for (int c = 0; c < width; c += square_columns)
  {
    Tile<groups, square_columns> tile;
    multiply(tile, rows, width, columns + c, width, n_columns);
    for (int i = 0; i < groups; ++i)
    {
      const long row = sides.groups[g + i];
      double *target = products + (row * (row + 1) / 2 + sides.groups[j]) * width * width;
      for (int k = 0; k < square_columns; ++k)
        for (int part = 0; part < parts; ++part)
        {
          double *sum = target + (c + k) * width + part * lanes;
          store(sum, load(sum) + tile.value[k][i * parts + part]);
        }
    }
  }
}

inline void accumulate_products(int first, int n_columns, const RightSides &sides, double *products)
{
  for (int j = 0; j < sides.n_groups; ++j)
  {
    int g = j;
    if constexpr (most_groups == 3)
    {
      for (; sides.n_groups - g >= 3 && sides.n_groups - g != 4; g += 3)
        square_tiles<3>(first, n_columns, sides, g, j, products);
      for (; sides.n_groups - g >= 2; g += 2)
        square_tiles<2>(first, n_columns, sides, g, j, products);
    }
    for (; g < sides.n_groups; ++g)
      square_tiles<1>(first, n_columns, sides, g, j, products);
  }
}

inline void accumulate_dots(int first, int n_columns, const RightSides &sides, const double *x, double *sums)
{
  for (int g = 0; g < sides.n_groups; ++g)
  {
    const double *own = sides.values[sides.groups[g]] + static_cast<long>(first) * width;
    double *target = sums + sides.groups[g] * width;
    Vector sum[parts];
    for (int p = 0; p < parts; ++p)
      sum[p] = load(target + p * lanes);
    for (int c = 0; c < n_columns; ++c)
      for (int p = 0; p < parts; ++p)
        sum[p] += load(own + c * width + p * lanes) * x[first + c];
    for (int p = 0; p < parts; ++p)
      store(target + p * lanes, sum[p]);
  }
}

inline void add_combination(int first, int n_columns, const RightSides &sides, const double *factors, double *x)
{
  for (int c = 0; c < n_columns; ++c)
  {
    Vector sum{};
    for (int g = 0; g < sides.n_groups; ++g)
      for (int p = 0; p < parts; ++p)
        sum += load(sides.values[sides.groups[g]] + static_cast<long>(first + c) * width + p * lanes) *
               load(factors + sides.groups[g] * width + p * lanes);
    x[first + c] += sum_of(sum);
  }
}
