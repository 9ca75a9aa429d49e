// Every kernel of one instruction set; see dense_body.h.
#include "registration/kernels/dense_body.h"
#include "registration/kernels/right_sides_body.h"
#include "registration/kernels/tetrahedra_body.h"

inline constexpr Kernels table(const char *instruction_set)
{
  return {instruction_set, factorise_columns,   update_matrix,   extend_add,      solve_lower,        solve_upper,
          eliminate,       accumulate_products, accumulate_dots, add_combination, assemble_tetrahedra};
}
