# Kinds: what a case chooses by a word, each in a file of its own. One more is that file and one line
#
#   fsi_kind(family name Type)
#
# in the list of its family; `name` is its word in case files, `Type` what its file declares. Whoever must know all kinds of a
# family includes a header that is made of these lines when configuring.
#
#   family          list                              file of a kind
#   riemann_solver  fluid_solver/kinds.cmake          fluid_solver/kernels/riemann/riemann_<name>.hpp
#   gas_boundary    fluid_solver/kinds.cmake          fluid_solver/boundary/kinds/<name>.hpp
#   law             solid_solver/kinds.cmake          solid_solver/laws/<name>.hpp
#   solid_boundary  solid_solver/kinds.cmake          solid_solver/boundary/kinds/<name>.hpp
#   shape           common/case/kinds.cmake           common/case/shapes/<name>.hpp
set(fsi_file_of_riemann_solver "fluid_solver/kernels/riemann/riemann_<name>.hpp")
set(fsi_file_of_gas_boundary "fluid_solver/boundary/kinds/<name>.hpp")
set(fsi_file_of_law "solid_solver/laws/<name>.hpp")
set(fsi_file_of_solid_boundary "solid_solver/boundary/kinds/<name>.hpp")
set(fsi_file_of_shape "common/case/shapes/<name>.hpp")

macro(fsi_kind family name type)
  list(APPEND fsi_${family}_names ${name})
  list(APPEND fsi_${family}_types ${type})
endmacro()

include(${PROJECT_SOURCE_DIR}/common/case/kinds.cmake)
include(${PROJECT_SOURCE_DIR}/fluid_solver/kinds.cmake)
include(${PROJECT_SOURCE_DIR}/solid_solver/kinds.cmake)

# fsi_made_of_kinds(template output NAMES name.. [FAMILY family] [EACH text])  a header of the build's folder `generated` from a
#   template, in which stand
#   @enumerators@  the names, @names@ the same as texts, @count@ how many there are
#   @includes@     of the files of the family, @types@ what they declare
#   @each@         `text` for every kind, with its name for <name> and what it declares for <Type>
function(fsi_made_of_kinds template output)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "FAMILY;EACH" "NAMES")
  if(ARG_FAMILY)
    set(ARG_NAMES ${fsi_${ARG_FAMILY}_names})
  endif()
  list(LENGTH ARG_NAMES count)
  list(JOIN ARG_NAMES ", " enumerators)
  list(TRANSFORM ARG_NAMES REPLACE "(.+)" "\"\\1\"" OUTPUT_VARIABLE names)
  list(JOIN names ", " names)
  list(JOIN fsi_${ARG_FAMILY}_types ", " types)
  set(includes "")
  set(each "")
  foreach(name type IN ZIP_LISTS ARG_NAMES fsi_${ARG_FAMILY}_types)
    string(REPLACE "<name>" "${name}" file "${fsi_file_of_${ARG_FAMILY}}")
    string(APPEND includes "#include \"${file}\"\n")
    string(REPLACE "<name>" "${name}" text "${ARG_EACH}")  # with its semicolons
    string(REPLACE "<Type>" "${type}" text "${text}")
    string(APPEND each "${text}\n")
  endforeach()
  configure_file(${template} ${PROJECT_BINARY_DIR}/generated/${output} @ONLY)
endfunction()
