# Compiler settings every target shares.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug or RelWithDebInfo" FORCE)
endif()

# Kernels (fsi_library's KERNELS) add -O3, which comes after these flags.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG")

set(FSI_MARCH native CACHE STRING "Instruction set of the kernels (-march=...); x86-64-v3 for a portable build")
option(FSI_WERROR "Warnings are errors: for changes to this project, not for its users (.ci/run sets it)" OFF)
option(FSI_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
option(FSI_SANITIZE_THREADS "Build with the thread sanitizer" OFF)
option(FSI_BENCH "Build the micro-benchmarks" ON)

# A compiler cache sees nothing through precompiled headers, so a build with one goes without them, and notices includes
# that are missing.
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(precompiled OFF)
else()
  set(precompiled ON)
endif()
option(FSI_PRECOMPILED "Parse the headers most sources begin with once, before all sources" ${precompiled})
option(FSI_TOGETHER "Compile the sources of a library a few at a time, but for kernels" ON)

# The kernels need -fno-math-errno -fno-trapping-math to vectorise; never -ffast-math.
# Contraction is pinned so that vector bodies and their tails round alike.
add_library(fsi_settings INTERFACE)
target_compile_options(fsi_settings INTERFACE
  $<BUILD_INTERFACE:$<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wshadow>>
  $<BUILD_INTERFACE:$<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${FSI_WERROR}>>:-Werror>>
  -march=${FSI_MARCH} -fno-math-errno -fno-trapping-math -ffp-contract=fast -fopenmp-simd
)
# g++ 12 takes the deliberately undefined registers of its own AVX-512 intrinsics (avx512fintrin.h, _mm512_undefined_*) for
# uninitialised variables wherever Eigen or a vectorised loop is inlined; g++ 13 no longer does. At -O3 it is even sure of it.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(fsi_settings INTERFACE -Wno-maybe-uninitialized -Wno-uninitialized)
endif()
# Checkpoints know the build that wrote them.
target_link_options(fsi_settings INTERFACE -Wl,--build-id=sha1)
if(FSI_SANITIZE)
  # Without what looks at every pointer, which doubles the time of a compilation (Eigen above all): the address sanitizer
  # notices a null or dangling one where it is used.
  target_compile_options(fsi_settings INTERFACE -fsanitize=address,undefined
    -fno-sanitize=null,alignment,vptr,object-size,pointer-overflow,nonnull-attribute,returns-nonnull-attribute
    -fno-sanitize-recover=undefined -fno-omit-frame-pointer
    -Og  # takes no longer to compile, and what is compiled is ten times as fast: libraries of templates
    -g1)  # names and lines for the reports; more would double the size of everything
  target_link_options(fsi_settings INTERFACE -fsanitize=address,undefined)
endif()

if(FSI_SANITIZE_THREADS)
  target_compile_options(fsi_settings INTERFACE -fsanitize=thread -O1 -fno-omit-frame-pointer -g1)
  target_link_options(fsi_settings INTERFACE -fsanitize=thread)
endif()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(Threads REQUIRED)
target_link_libraries(fsi_settings INTERFACE Eigen3::Eigen fmt::fmt)
# Eigen's matrices lie in memory alike for every instruction set (by itself it aligns them to the widest register), so that
# objects compiled for different ones can be linked: tests/instruction_sets, and solids of one's own.
target_compile_definitions(fsi_settings INTERFACE EIGEN_MAX_STATIC_ALIGN_BYTES=16 EIGEN_MAX_ALIGN_BYTES=64)
