# What every target of ours gets: strict warnings, reproducible floating point, the root as include path.
add_library(spheroscope_flags INTERFACE)
target_include_directories(spheroscope_flags INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(spheroscope_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast
  # Clang also means floats that are widened on purpose
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
  # GCC 12 sees overlaps, lengths and bounds in strings that are not there (GCC bugs 105651, 105329)
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread>
  # a*b+c is rounded twice everywhere, so that results do not depend on what the compiler fuses
  -ffp-contract=off)
if(SPHEROSCOPE_WERROR)
  target_compile_options(spheroscope_flags INTERFACE -Werror)
endif()
if(SPHEROSCOPE_CHECKS)
  target_compile_definitions(spheroscope_flags INTERFACE SPHEROSCOPE_CHECKS)
endif()
if(SPHEROSCOPE_SANITIZE)
  set(sanitizer_flags -fsanitize=${SPHEROSCOPE_SANITIZE} -fno-omit-frame-pointer
                      -fno-sanitize-recover=all)
  # instrumented code makes GCC take initialised variables for uninitialised ones (std::regex)
  target_compile_options(spheroscope_flags INTERFACE ${sanitizer_flags}
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(spheroscope_flags INTERFACE ${sanitizer_flags})
  if(SPHEROSCOPE_SANITIZE MATCHES "address|thread")
    # for tests that count memory: these two allocate themselves
    target_compile_definitions(spheroscope_flags INTERFACE SPHEROSCOPE_SANITIZER_ALLOCATES)
  endif()
endif()
find_package(Threads REQUIRED)
target_link_libraries(spheroscope_flags INTERFACE Threads::Threads)

find_package(Eigen3 REQUIRED NO_MODULE)
add_library(spheroscope_eigen INTERFACE)
target_include_directories(spheroscope_eigen SYSTEM INTERFACE ${EIGEN3_INCLUDE_DIRS})
# Without SIMD in Eigen's small types the sums have one order on every machine.
target_compile_definitions(spheroscope_eigen INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY)

# spheroscope_library(NAME deps...): a static library of all sources of the folder NAME of engine/.
# The link list is the dependency rule: what is not listed cannot be used without a link error.
# A folder that has headers only passes its dependencies on. Sources begin with the precompiled headers
# `numeric`, in folders that write text with `text`.
function(spheroscope_library name)
  set(headers numeric)
  if("fmt::fmt" IN_LIST ARGN)
    set(headers text)
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "main\\.cpp$")
  if(sources)
    add_library(spheroscope_${name} STATIC ${sources})
    target_link_libraries(spheroscope_${name} PUBLIC spheroscope_flags spheroscope_eigen ${ARGN})
    spheroscope_precompiled(spheroscope_${name} ${headers})
  else()
    add_library(spheroscope_${name} INTERFACE)
    target_link_libraries(spheroscope_${name} INTERFACE spheroscope_flags spheroscope_eigen ${ARGN})
  endif()
endfunction()
