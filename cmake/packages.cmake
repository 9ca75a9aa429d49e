# Everything comes from Debian 12; `./dev packages` installs it.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(deal.II 9.4 REQUIRED HINTS /usr)
# Debian's deal.II brings the MPI HDF5, VTK the serial one: the store links the serial one by name and nothing else.
find_path(HDF5_SERIAL_INCLUDE_DIR hdf5.h PATHS /usr/include/hdf5/serial NO_DEFAULT_PATH REQUIRED)
find_library(HDF5_SERIAL_LIBRARY hdf5_serial REQUIRED)
find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(UMFPACK_LIBRARY umfpack REQUIRED)
find_library(OPENBLAS_LIBRARY openblas REQUIRED)
# OpenCV by name: its CMake package wants every module installed.
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
find_library(OPENCV_CORE_LIBRARY opencv_core REQUIRED)
find_library(OPENCV_IMGPROC_LIBRARY opencv_imgproc REQUIRED)
find_library(OPENCV_VIDEO_LIBRARY opencv_video REQUIRED)
find_path(FFTW_INCLUDE_DIR fftw3.h REQUIRED)
find_library(FFTW_LIBRARY fftw3 REQUIRED)
# GDCM by name: its CMake package wants its command-line tools installed.
find_path(GDCM_INCLUDE_DIR gdcmReader.h PATH_SUFFIXES gdcm-3.0 REQUIRED)
foreach(part MSFF DSED DICT Common)
  find_library(GDCM_${part}_LIBRARY gdcm${part} REQUIRED)
endforeach()
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_program(NODE node)
find_program(NPM npm)
if(NOT NODE OR NOT NPM)
  message(FATAL_ERROR "node and npm, which bundle the script of the report's page, are not in PATH; install the Debian "
                      "packages nodejs and npm (`./dev packages` does)")
endif()
find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel FiltersCore IOGeometry IOHDF IOXML IOImage FiltersGeneral FiltersSources
             RenderingCore RenderingOpenGL2 RenderingFreeType RenderingAnnotation InteractionStyle)

add_library(gmsh_api INTERFACE)
target_include_directories(gmsh_api SYSTEM INTERFACE ${GMSH_INCLUDE_DIR})
target_link_libraries(gmsh_api INTERFACE ${GMSH_LIBRARY})

add_library(hdf5_serial INTERFACE)
target_include_directories(hdf5_serial SYSTEM INTERFACE ${HDF5_SERIAL_INCLUDE_DIR})
target_link_libraries(hdf5_serial INTERFACE ${HDF5_SERIAL_LIBRARY})

add_library(fftw INTERFACE)
target_include_directories(fftw SYSTEM INTERFACE ${FFTW_INCLUDE_DIR})
target_link_libraries(fftw INTERFACE ${FFTW_LIBRARY})

add_library(gdcm INTERFACE)
target_include_directories(gdcm SYSTEM INTERFACE ${GDCM_INCLUDE_DIR})
target_link_libraries(gdcm INTERFACE ${GDCM_MSFF_LIBRARY} ${GDCM_DICT_LIBRARY} ${GDCM_DSED_LIBRARY} ${GDCM_Common_LIBRARY})

add_library(suitesparse INTERFACE)
target_include_directories(suitesparse SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
target_link_libraries(suitesparse INTERFACE ${CHOLMOD_LIBRARY} ${UMFPACK_LIBRARY} ${OPENBLAS_LIBRARY})

add_library(opencv_video_api INTERFACE)
target_include_directories(opencv_video_api SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
target_link_libraries(opencv_video_api INTERFACE ${OPENCV_VIDEO_LIBRARY} ${OPENCV_IMGPROC_LIBRARY} ${OPENCV_CORE_LIBRARY})

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
endif()
