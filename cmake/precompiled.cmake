# Headers that are compiled once instead of in every source: four fifths of a source's compile time
# were these. A source includes what it uses all the same: a build with
# -DSPHEROSCOPE_PRECOMPILED_HEADERS=OFF tells. CLI11 and nlohmann's JSON are not among them: what they
# instantiate is compiled again in every source that only sees them.
option(SPHEROSCOPE_PRECOMPILED_HEADERS "Compile common headers of libraries once" ON)
# ccache (if any) has to be told that a precompiled header stands for what it was made of
if(SPHEROSCOPE_PRECOMPILED_HEADERS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-fpch-preprocess)
endif()

set(precompiled_standard
  <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <cstdio> <cstring>
  <deque> <filesystem> <fstream> <functional> <limits> <map> <memory> <mutex> <numbers> <numeric>
  <optional> <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread>
  <type_traits> <unordered_map> <utility> <variant> <vector>)
set(precompiled_matrices <Eigen/Dense>)

# One library of headers: NAME, the targets that provide them, the headers.
function(spheroscope_precompiled_headers name targets)
  add_library(precompiled_${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled/empty.cpp)
  target_link_libraries(precompiled_${name} PRIVATE spheroscope_flags spheroscope_eigen ${targets})
  target_precompile_headers(precompiled_${name} PRIVATE ${ARGN})
endfunction()

# spheroscope_precompiled(TARGET NAME): TARGET's sources begin with the headers NAME.
function(spheroscope_precompiled target name)
  if(NOT SPHEROSCOPE_PRECOMPILED_HEADERS)
    return()
  endif()
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "INTERFACE_LIBRARY")
    target_precompile_headers(${target} REUSE_FROM precompiled_${name})
  endif()
endfunction()

if(SPHEROSCOPE_PRECOMPILED_HEADERS)
  find_package(fmt REQUIRED)
  spheroscope_precompiled_headers(numeric "" ${precompiled_standard} ${precompiled_matrices})
  spheroscope_precompiled_headers(text fmt::fmt
    ${precompiled_standard} ${precompiled_matrices} <fmt/format.h>)
  if(SPHEROSCOPE_TESTS)
    find_package(GTest REQUIRED)
    spheroscope_precompiled_headers(tests GTest::gtest
      ${precompiled_standard} ${precompiled_matrices} <gtest/gtest.h>)
  endif()
endif()
