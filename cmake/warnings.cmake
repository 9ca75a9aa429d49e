# Linked PRIVATE and last by every target of ours. Every include is a full path from the root.
add_library(project_warnings INTERFACE)
target_compile_options(project_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual)
if(PELVIREG_WERROR)
  target_compile_options(project_warnings INTERFACE -Werror)
endif()
target_include_directories(project_warnings INTERFACE ${PROJECT_SOURCE_DIR})
# The same bytes on every run: no contraction that depends on the optimiser's mood across translation units.
target_compile_options(project_warnings INTERFACE -ffp-contract=off)
