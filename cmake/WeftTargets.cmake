# weft_library(NAME SOURCES a.cpp … [PUBLIC dep …] [PRIVATE dep …])
#   One static library per folder, linked as weft::NAME. A library without sources is an interface.
function(weft_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    set(target weft_${name})
    if(ARG_SOURCES)
        add_library(${target} STATIC ${ARG_SOURCES})
        target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                    $<INSTALL_INTERFACE:include/weft>)
        target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
    else()
        add_library(${target} INTERFACE)
        target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                       $<INSTALL_INTERFACE:include/weft>)
        target_link_libraries(${target} INTERFACE ${ARG_PUBLIC})
    endif()
    add_library(weft::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    set_property(GLOBAL APPEND PROPERTY WEFT_LIBRARIES ${target})
endfunction()

# weft_precompile(NAME header…)
#   Headers that nearly every source of a library includes, parsed once for all of them. The sources include what they
#   use all the same: unity builds (preset "unity"), and clang-tidy, go without.
function(weft_precompile name)
    target_precompile_headers(weft_${name} PRIVATE ${ARGN})
    # For the compiler cache.
    target_compile_options(weft_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# weft_reuse_precompiled(NAME FROM)
#   The headers that were parsed for another library, which has the same flags.
function(weft_reuse_precompiled name from)
    target_precompile_headers(weft_${name} REUSE_FROM weft_${from})
    target_compile_options(weft_${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# weft_test(NAME SOURCES a_test.cpp … [LIBS dep …] [LABELS full] [OPTIMISED] [TOGETHER] [FIRST Suite …])
#   One GoogleTest program per folder, each of its suites one test for ctest. With the label "full" the whole program is
#   one test instead: listing a program's suites means starting it, and a plain ./test need not start what it will not
#   run.
#   OPTIMISED: the tests' own code works for long, such as a search by brute force.
#   TOGETHER: the whole program is one test, because loading its libraries (OpenImageIO's, 260 of them: 0.3 s) takes
#   longer than most of its suites.
#   FIRST: suites that take long. They start before the others, as whole programs do, so that none of them is alone at
#   the end; ctest knows no times in a fresh clone.
function(weft_test name)
    cmake_parse_arguments(ARG "OPTIMISED;TOGETHER" "" "SOURCES;LIBS;LABELS;FIRST" ${ARGN})
    set(target test_${name})
    add_executable(${target} ${ARG_SOURCES})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target} PRIVATE ${ARG_LIBS} weft_test_places GTest::gmock GTest::gtest_main)
    # Tests draw pictures, and the linker may take their copies of inline functions for the engine's: without any
    # optimisation test_mask takes twice the time. More of it costs more to compile than it saves.
    if(NOT ARG_OPTIMISED)
        target_compile_options(${target} PRIVATE -O1)
    endif()
    if("full" IN_LIST ARG_LABELS)
        add_test(NAME ${name} COMMAND ${target})
        set_tests_properties(${name} PROPERTIES TIMEOUT 3600 LABELS "${ARG_LABELS}")
    elseif(ARG_TOGETHER)
        # Brief: the end of what a failed test printed is shown, and that must be its failures.
        add_test(NAME ${name} COMMAND ${target} --gtest_brief=1)
        set_tests_properties(${name} PROPERTIES TIMEOUT 1800 COST 10)
    else()
        set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
        file(GENERATE OUTPUT ${suites} CONTENT "set(program \"$<TARGET_FILE:${target}>\")
set(folder \"${CMAKE_CURRENT_BINARY_DIR}\")
set(name \"${name}\")
set(timeout 1800)
set(labels \"${ARG_LABELS}\")
set(first \"${ARG_FIRST}\")
include(\"${PROJECT_SOURCE_DIR}/cmake/TestSuites.cmake\")
")
        set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${suites})
    endif()
endfunction()
