# What was built, for `fsi --version` and every summary.json: <build>/bin/build.json, written by write_build_info.cmake at the
# end of every build. It stands beside the programs and not in them, so that a commit compiles nothing anew and a restart, which
# wants the same programs, survives it.

# "native" stands for another instruction set on each machine; the compiler says for which one.
function(fsi_instruction_set march result)
  set(${result} ${march} PARENT_SCOPE)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    return()
  endif()
  execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=${march} -Q --help=target
    RESULT_VARIABLE code OUTPUT_VARIABLE options ERROR_QUIET)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "Error: FSI_MARCH=${march}: ${CMAKE_CXX_COMPILER} knows no such instruction set; write native, x86-64-v2, "
      "x86-64-v3, x86-64-v4 or another value of its -march")
  endif()
  if(options MATCHES "-march=[ \t]+([^ \t\n]+)")
    set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
  endif()
endfunction()

fsi_instruction_set(${FSI_MARCH} instruction_set)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(compiler "g++ ${CMAKE_CXX_COMPILER_VERSION}")
else()
  set(compiler "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
endif()

add_custom_target(fsi_build_info ALL
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -D FILE=${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/build.json
    -D VERSION=${PROJECT_VERSION} -D COMPILER=${compiler} -D BUILD_TYPE=${CMAKE_BUILD_TYPE} -D MARCH=${FSI_MARCH}
    -D INSTRUCTION_SET=${instruction_set} -P ${PROJECT_SOURCE_DIR}/cmake/write_build_info.cmake
  COMMENT "Writing down what is built"
  VERBATIM)
