# The built-in cases, in the order in which `pelvireg cases` lists them: one file NAME.toml each.
set(built_in_cases t005 t005_large t007 t007_large t005_selfgen quick
    t005_half_stiffness t005_double_stiffness t005_neo_hookean t005_moved_insertions t005_leaking)
