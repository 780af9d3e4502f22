# cmake -D ROOT=.. -D FILE=.. -D VERSION=.. -D COMPILER=.. -D BUILD_TYPE=.. -D MARCH=.. -D INSTRUCTION_SET=.. -P this
# Writes FILE as JSON: the values above, the commit of ROOT and whether files that git knows differ from it, those of docs/
# left out: nothing is built from them, and what records results writes there between two runs. Both are null where
# ROOT is no git repository of its own (an unpacked archive, a copy within somebody else's repository) or there is no git.
# A FILE that would stay the same is not touched.
cmake_minimum_required(VERSION 3.25)

set(commit null)
set(modified null)
find_program(GIT git)
if(GIT)
  # The user of a build, root perhaps, need not own the files. No lock: somebody may be committing.
  set(git ${GIT} -C ${ROOT} --no-optional-locks -c safe.directory=${ROOT})
  execute_process(COMMAND ${git} rev-parse --show-prefix HEAD
    RESULT_VARIABLE code OUTPUT_VARIABLE answer ERROR_QUIET)
  if(code EQUAL 0 AND answer MATCHES "^\n([0-9a-f]+)\n$")  # the first line is empty at the top of a repository
    set(commit "\"${CMAKE_MATCH_1}\"")
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no -- :/ :!/docs
      OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      set(modified true)
    else()
      set(modified false)
    endif()
  endif()
endif()

file(CONFIGURE OUTPUT ${FILE}.new @ONLY CONTENT "{
  \"version\": \"@VERSION@\",
  \"commit\": @commit@,
  \"modified\": @modified@,
  \"compiler\": \"@COMPILER@\",
  \"build_type\": \"@BUILD_TYPE@\",
  \"march\": \"@MARCH@\",
  \"instruction_set\": \"@INSTRUCTION_SET@\"
}
")
file(COPY_FILE ${FILE}.new ${FILE} ONLY_IF_DIFFERENT)
file(REMOVE ${FILE}.new)
