# fsi_library(name SOURCES ... DEPENDS ...)     a static library seen from the repository root: #include "common/core/field.hpp"
# fsi_program(name SOURCES ... DEPENDS ...)     an executable in <build>/bin
#   the target `programs` builds all that a run may need, and no tests
# fsi_test(name LABEL unit SOURCES ... DEPENDS ...)  a GoogleTest executable; every TEST becomes one CTest test
#   the target `tests_<label>` builds all of one label

function(fsi_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} PUBLIC fsi_settings ${ARG_DEPENDS})
  else()
    add_library(${name} INTERFACE)
    target_include_directories(${name} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name} INTERFACE fsi_settings ${ARG_DEPENDS})
  endif()
endfunction()

add_custom_target(programs)

function(fsi_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE fsi_settings ${ARG_DEPENDS})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT folder MATCHES "^(tests|bench)")
    add_dependencies(programs ${name})
  endif()
endfunction()

foreach(label IN ITEMS unit programs convergence regression)
  add_custom_target(tests_${label})
endforeach()

function(fsi_test name)
  if(NOT BUILD_TESTING)
    return()
  endif()
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;DEPENDS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  find_package(GTest REQUIRED)
  include(GoogleTest)
  fsi_program(${name} SOURCES ${ARG_SOURCES} DEPENDS ${ARG_DEPENDS} GTest::gtest_main)
  add_dependencies(tests_${ARG_LABEL} ${name})
  gtest_discover_tests(${name} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT} DISCOVERY_TIMEOUT 60)
endfunction()
