// Eight corotational linear tetrahedra at a time, of one instruction set; see dense_body.h. What an element is, and
// why, stands in registration/elements/tetrahedron.h.

inline Vector dot(const Vector *a, const Vector *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// f[3 * column + row] = sum of (x_a - x_0) gradient_a^T.
inline void deformation_gradient(const TetrahedronGroup &group, const double *positions, int part, Vector (&f)[9])
{
  Vector x[4][3];
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < lanes; ++l)
        x[a][i][l] = positions[3L * group.nodes[a][part * lanes + l] + i];
  for (int i = 0; i < 9; ++i)
    f[i] = Vector{};
  for (int a = 1; a < 4; ++a)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        f[3 * j + i] += (x[a][i] - x[0][i]) * load(group.gradients[3 * a + j] + part * lanes);
}

inline void cofactor(const Vector (&q)[9], Vector (&c)[9])
{
  for (int j = 0; j < 3; ++j)
  {
    const Vector *a = q + 3 * ((j + 1) % 3), *b = q + 3 * ((j + 2) % 3);
    for (int i = 0; i < 3; ++i)
      c[3 * j + i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
  }
}

inline Vector squared_norm(const Vector (&m)[9])
{
  return dot(m, m) + dot(m + 3, m + 3) + dot(m + 6, m + 6);
}

using Mask = decltype(Vector{} < Vector{});

inline bool any(const Mask &mask)
{
  for (int l = 0; l < lanes; ++l)
    if (mask[l])
      return true;
  return false;
}

/// Newton's iteration for the polar factor, Q <- (Q + Q^-T) / 2, for all lanes at once; quadratic, and a strain of 30 %
/// needs five. Lanes that are flat, inverted or slow are left to `rotation`.
inline void rotations(const Vector (&f)[9], RotationOf rotation, Vector (&q)[9])
{
  constexpr int most_iterations = 8;
  constexpr double flat = 1e-6, squared_tolerance = 1e-16; // as in rotation_of()
  Vector c[9];
  cofactor(f, c);
  Vector determinant = dot(f, c);
  const Vector squared_scale = squared_norm(f);
  const Vector flat_determinant = flat * flat * squared_scale * squared_scale * squared_scale;
  Mask is_left = ~((determinant * determinant > flat_determinant) & (determinant > 0));
  const Vector one = Vector{} + 1;
  for (int i = 0; i < 9; ++i)
    q[i] = is_left ? (i % 4 == 0 ? one : Vector{}) : f[i];
  for (int iteration = 0; iteration < most_iterations; ++iteration)
  {
    cofactor(q, c);
    const Vector factor = 0.5 / dot(q, c);
    Vector squared_change{};
    for (int i = 0; i < 9; ++i)
    {
      const Vector next = 0.5 * q[i] + factor * c[i];
      squared_change += (next - q[i]) * (next - q[i]);
      q[i] = next;
    }
    const Mask is_open = ~(squared_change < squared_tolerance);
    if (!any(is_open))
      break;
    if (iteration + 1 == most_iterations)
      is_left = is_left | is_open;
  }
  for (int l = 0; l < lanes; ++l)
    if (is_left[l])
    {
      double gradient[9], turn[9];
      for (int i = 0; i < 9; ++i)
        gradient[i] = f[i][l];
      rotation(gradient, turn);
      for (int i = 0; i < 9; ++i)
        q[i][l] = turn[i];
    }
}

/// Volume times the first Piola-Kirchhoff stress, Q (lambda tr(E) I + 2 mu E) with E = sym(Q^T F) - I.
inline void stress(const Vector (&f)[9], const Vector (&q)[9], const Vector &lambda, const Vector &mu, Vector (&p)[9])
{
  Vector s[9]; // Q^T F, then its stress
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      s[3 * j + i] = dot(q + 3 * i, f + 3 * j);
  const Vector trace = lambda * (s[0] + s[4] + s[8] - 3.0);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < j; ++i)
      s[3 * j + i] = s[3 * i + j] = mu * (s[3 * j + i] + s[3 * i + j]);
  for (int i = 0; i < 3; ++i)
    s[4 * i] = trace + 2.0 * mu * (s[4 * i] - 1.0);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      p[3 * j + i] = q[i] * s[3 * j] + q[3 + i] * s[3 * j + 1] + q[6 + i] * s[3 * j + 2];
}

inline void assemble_part(const TetrahedronGroup &group, const double *positions, RotationOf rotation, int part,
                          TetrahedronResult &result)
{
  const int at = part * lanes;
  const Vector lambda = load(group.volume_lambda + at), mu = load(group.volume_mu + at);
  Vector f[9], q[9], p[9];
  deformation_gradient(group, positions, part, f);
  rotations(f, rotation, q);
  stress(f, q, lambda, mu, p);
  Vector turned[4][3];
  for (int a = 0; a < 4; ++a)
  {
    Vector gradient[3];
    for (int i = 0; i < 3; ++i)
      gradient[i] = load(group.gradients[3 * a + i] + at);
    for (int i = 0; i < 3; ++i)
    {
      turned[a][i] = q[i] * gradient[0] + q[3 + i] * gradient[1] + q[6 + i] * gradient[2];
      store(result.forces[3 * a + i] + at, p[i] * gradient[0] + p[3 + i] * gradient[1] + p[6 + i] * gradient[2]);
    }
  }
  int block = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b <= a; ++b, ++block)
    {
      const Vector diagonal = mu * dot(turned[a], turned[b]);
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
        {
          Vector entry = lambda * turned[a][i] * turned[b][j] + mu * turned[b][i] * turned[a][j];
          if (i == j)
            entry += diagonal;
          store(result.blocks[9 * block + 3 * j + i] + at, entry);
        }
    }
}

inline void assemble_tetrahedra(const TetrahedronGroup &group, const double *positions, RotationOf rotation,
                                TetrahedronResult &result)
{
  for (int part = 0; part < parts; ++part)
    assemble_part(group, positions, rotation, part, result);
}
