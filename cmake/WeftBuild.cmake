# Language level, warnings, sanitizers, and the flags that results depend on.
option(WEFT_WERROR "Treat warnings as errors (CI)" OFF)
option(WEFT_TESTS "Build the tests" ON)
option(WEFT_BENCH "Build the benchmarks in bench/" OFF)
option(WEFT_FUZZ "Build the libFuzzer targets in fuzz/ (clang)" OFF)
option(WEFT_MOVIES "Read and write movies, with FFmpeg (docs/LICENCES.md)" ON)
set(WEFT_LICENCE "" CACHE STRING "The licence under which Weft itself is given, as an SPDX expression; empty: not chosen yet")
set(WEFT_SANITIZE "" CACHE STRING "Sanitizers to build with: empty, address or thread")
set(WEFT_CPU "" CACHE STRING "Least processor for the engine: empty for any x86-64, or x86-64-v3 (AVX2) for a build that stays on its machine")
set(WEFT_CUDA AUTO CACHE STRING "CUDA backend: AUTO (when nvcc is found), ON or OFF")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# -O3 stands at the engine and at the folders whose loops gain by it; elsewhere it only takes longer to compile.
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")
if(WEFT_SANITIZE)
    # Compiles in 60 % of the time, which a build that is made for one run of the tests pays for most.
    set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")
endif()

if(NOT WEFT_CPU MATCHES "^(x86-64-v3)?$")
    message(FATAL_ERROR "WEFT_CPU is '${WEFT_CPU}': use x86-64-v3, or leave it empty")
endif()

find_program(WEFT_CCACHE ccache)
if(WEFT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${WEFT_CCACHE})
endif()
find_program(WEFT_MOLD mold)
if(WEFT_MOLD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12.1)
    # mold 1.10 lets the read-only part begin at an empty .tbss, in a page that nothing maps, when
    # that happens to lie at a page's end; the loader then refuses the program ("cannot apply
    # additional memory protection after relocation"). Without that part nothing can be wrong with it.
    add_link_options(-fuse-ld=mold -Wl,-z,norelro)
endif()

# Contraction of a*b+c into FMA would make results depend on the instruction set
# (docs/decisions/0002-determinism.md), so it is off everywhere.
add_compile_options(
    $<$<COMPILE_LANGUAGE:CXX>:-ffp-contract=off>
    $<$<COMPILE_LANGUAGE:CXX>:-Wall> $<$<COMPILE_LANGUAGE:CXX>:-Wextra>
    $<$<COMPILE_LANGUAGE:CXX>:-Wshadow> $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
    $<$<COMPILE_LANGUAGE:CXX>:-Woverloaded-virtual> $<$<COMPILE_LANGUAGE:CXX>:-Wundef>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 mistakes moved vectors inside an Expected for stack memory (GCC bug 104475 and kin).
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-free-nonheap-object>)
    # The same of strings that are put together (GCC bug 105651), at -O3 only.
    add_compile_options($<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CONFIG:Release>>:-Wno-restrict>)
endif()
if(WEFT_WERROR)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
if(WEFT_SANITIZE STREQUAL "address")
    add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
    add_link_options(-fsanitize=address,undefined)
elseif(WEFT_SANITIZE STREQUAL "thread")
    add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
    add_link_options(-fsanitize=thread)
elseif(WEFT_SANITIZE STREQUAL "fuzzer")
    # Coverage for libFuzzer, with the sanitizers that find what it provokes.
    add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-omit-frame-pointer
                        -fno-sanitize-recover=undefined)
    add_link_options(-fsanitize=address,undefined)
elseif(NOT WEFT_SANITIZE STREQUAL "")
    message(FATAL_ERROR "WEFT_SANITIZE is '${WEFT_SANITIZE}': use address, thread or fuzzer, or leave it empty")
endif()
