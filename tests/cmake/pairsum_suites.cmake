# pairsum_discover_suites(TARGET PROPERTIES...): the tests of a GoogleTest program, one process for each suite. For each test, as
# gtest_discover_tests makes them, starting 2900 programs takes longer than what they test. `--gtest_filter` runs one alone.
function(pairsum_discover_suites target)
  set(listed ${CMAKE_CURRENT_BINARY_DIR}/${target}_listed.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${listed} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D LISTED=${listed}
      -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/list_suites.cmake)
  list(TRANSFORM ARGN REPLACE "(.+)" "[==[\\1]==]")
  list(JOIN ARGN " " properties)
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  file(WRITE ${suites} "set(properties ${properties})\n"
    "if(EXISTS \"${listed}\")\n  include(\"${listed}\")\nelse()\n  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${suites})
endfunction()

# pairsum_compile_together(TARGET): its sources are compiled four at a time, since most of the time goes into headers. So what a
# test has at file scope needs a name that its neighbours do not have.
function(pairsum_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 4)
endfunction()
