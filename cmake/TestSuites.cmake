# Read by ctest before it runs: makes one test of each suite of a GoogleTest program, which is faster than one of each
# test by as many starts of the program. The caller sets `program`, `name`, `timeout` and `labels`. What a program holds
# is asked of the program itself, once after each build, so that no suite can be left out.
if(NOT EXISTS "${program}")
    add_test("${name}_not_built" "${program}")
    return()
endif()
set(list "${program}.suites")
if("${program}" IS_NEWER_THAN "${list}")
    execute_process(COMMAND "${program}" --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        add_test("${name}_not_listed" "${program}" --gtest_list_tests)
        return()
    endif()
    # A suite begins a line and ends with a dot; its tests are indented.
    string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
    list(TRANSFORM suites REPLACE "\n" "")
    list(REMOVE_DUPLICATES suites)
    file(WRITE "${list}" "${suites}")
endif()
file(READ "${list}" suites)
foreach(suite IN LISTS suites)
    string(REGEX REPLACE "\\.$" "" title "${suite}")
    add_test("${name}.${title}" "${program}" "--gtest_filter=${suite}*")
    set_tests_properties("${name}.${title}" PROPERTIES TIMEOUT "${timeout}" LABELS "${labels}"
        WORKING_DIRECTORY "${folder}")
endforeach()
