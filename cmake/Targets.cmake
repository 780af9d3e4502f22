# fsi_library(name [COLD] SOURCES ... KERNELS ... DEPENDS ...)  a static library seen from the repository root: #include
#   "common/core/field.hpp"; KERNELS are the sources with the loops over all points, compiled with -O3; COLD where the time
#   loop never comes
#   the target `kernels` compiles all of these and nothing else
# fsi_program(name SOURCES ... DEPENDS ...)     an executable in <build>/bin
#   the target `programs` builds all that a run may need, and no tests
# fsi_test(name LABEL unit SOURCES ... DEPENDS ...)  a GoogleTest executable; every TEST becomes one CTest test
#   the target `tests_<label>` builds all of one label

# Most of the time of a compilation goes into the headers of the standard library, fmt, Eigen and GoogleTest, so they are
# parsed once: fsi_precompiled for all sources, fsi_precompiled_tests for those of tests, _kernels for kernels and _cold for
# what is cold, since g++ takes the optimisation that precompiled headers were compiled with.
function(fsi_precompiled name)
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE fsi_settings ${ARGN})
endfunction()

# -O3 pays in the loops over all points alone; elsewhere it makes compilations longer.
function(fsi_kernel_options name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O3>)
endfunction()

# -Og takes two thirds of the time of -O2 where nobody waits for what is compiled: outside the time loop, and in tests, whose
# libraries are those of the programs.
function(fsi_cold_options name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-Og>)
endfunction()

# What a test itself has on its stack is not watched for use after its scope: in the macros of GoogleTest, with a few objects
# of each comparison, that is a sixth of the time of a compilation.
function(fsi_test_options name)
  fsi_cold_options(${name})
  if(FSI_SANITIZE)
    target_compile_options(${name} PRIVATE -fno-sanitize-address-use-after-scope)
  endif()
endfunction()

if(FSI_PRECOMPILED)
  fsi_precompiled(fsi_precompiled)
  target_precompile_headers(fsi_precompiled PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.hpp)
  fsi_precompiled(fsi_precompiled_cold)
  fsi_cold_options(fsi_precompiled_cold)
  target_precompile_headers(fsi_precompiled_cold PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.hpp)
  fsi_precompiled(fsi_precompiled_kernels)
  fsi_kernel_options(fsi_precompiled_kernels)
  target_precompile_headers(fsi_precompiled_kernels PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.hpp)
  if(BUILD_TESTING)
    find_package(GTest REQUIRED)
    fsi_precompiled(fsi_precompiled_tests GTest::gtest)
    fsi_test_options(fsi_precompiled_tests)
    target_precompile_headers(fsi_precompiled_tests PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.hpp <gtest/gtest.h>)
  endif()
endif()

function(fsi_precompile name)
  if(FSI_PRECOMPILED)
    target_precompile_headers(${name} REUSE_FROM ${ARGN})
  endif()
endfunction()

add_custom_target(kernels)

# Sources compiled together, a few at a time: what their templates have in common is then made once, which is half of their
# time and more. Not kernels: what is inlined from another source may be rounded otherwise (-ffp-contract). Their anonymous
# namespaces become one: a name that two sources of a library use for different things does not compile.
function(fsi_together name)
  if(FSI_TOGETHER)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 13)
    # It warns of types of anonymous namespaces in included files, which the sources are here.
    target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
  endif()
endfunction()

# g++ 12 sees a store of eight numbers into Eigen's 2 x 2 matrices, in a branch of its eigenvalues that is never taken; g++ 13
# does not.
function(fsi_false_array_bounds name)
  if(TARGET ${name} AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${name} PRIVATE -Wno-array-bounds)
  endif()
endfunction()

function(fsi_library name)
  cmake_parse_arguments(ARG "COLD" "" "SOURCES;KERNELS;DEPENDS" ${ARGN})
  if(ARG_SOURCES OR ARG_KERNELS)
    if(ARG_KERNELS)
      add_library(${name}_kernels OBJECT ${ARG_KERNELS})
      fsi_kernel_options(${name}_kernels)
      fsi_precompile(${name}_kernels fsi_precompiled_kernels)
      target_include_directories(${name}_kernels PRIVATE ${PROJECT_SOURCE_DIR})
      target_link_libraries(${name}_kernels PRIVATE fsi_settings ${ARG_DEPENDS})
      add_dependencies(kernels ${name}_kernels)
      list(APPEND ARG_SOURCES $<TARGET_OBJECTS:${name}_kernels>)
    endif()
    add_library(${name} STATIC ${ARG_SOURCES})
    set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
    fsi_together(${name})
    target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    target_link_libraries(${name} PUBLIC fsi_settings ${ARG_DEPENDS})
    if(ARG_COLD)
      fsi_cold_options(${name})
      fsi_precompile(${name} fsi_precompiled_cold)
    else()
      fsi_precompile(${name} fsi_precompiled)
    endif()
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
    target_link_libraries(${name} INTERFACE fsi_settings ${ARG_DEPENDS})
  endif()
endfunction()

add_custom_target(programs)

function(fsi_program name)
  cmake_parse_arguments(ARG "" "PRECOMPILED" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED fsi_precompiled)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE fsi_settings ${ARG_DEPENDS})
  fsi_precompile(${name} ${ARG_PRECOMPILED})
  fsi_together(${name})
  add_dependencies(${name} fsi_build_info)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT folder MATCHES "^(tests|bench)")
    add_dependencies(programs ${name})
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/amp_fsi COMPONENT programs)
  endif()
endfunction()

foreach(label IN ITEMS unit programs convergence regression)
  add_custom_target(tests_${label})
endforeach()

# No test takes as long on any machine, however busy: it hangs [s].
set(fsi_watchdog_s 3600)

function(fsi_test name)
  if(NOT BUILD_TESTING)
    return()
  endif()
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;DEPENDS" ${ARGN})
  find_package(GTest REQUIRED)
  include(GoogleTest)
  fsi_program(${name} SOURCES ${ARG_SOURCES} DEPENDS ${ARG_DEPENDS} GTest::gtest_main PRECOMPILED fsi_precompiled_tests)
  fsi_test_options(${name})
  # A local name may be that of something in another test.
  set_target_properties(${name} PROPERTIES UNITY_BUILD_CODE_BEFORE_INCLUDE "#pragma GCC diagnostic ignored \"-Wshadow\"")
  add_dependencies(tests_${ARG_LABEL} ${name})
  gtest_discover_tests(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${fsi_watchdog_s} DISCOVERY_TIMEOUT 600)
endfunction()
