# GNU ld takes 20 s for a program with deal.II's hundred libraries, gold (of the same package, binutils) 2 s.
# gold takes a symbol from the first library that has it: the serial HDF5 goes before the MPI one that deal.II brings.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold PELVIREG_HAS_GOLD)
if(PELVIREG_HAS_GOLD)
  add_link_options(-fuse-ld=gold "LINKER:--push-state,--as-needed,${HDF5_SERIAL_LIBRARY},--pop-state")
endif()
