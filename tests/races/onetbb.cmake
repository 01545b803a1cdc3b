# Read before the library looks for oneTBB: one that ThreadSanitizer sees into, if it can be built.
find_program(sh sh REQUIRED)
execute_process(COMMAND ${sh} ${CMAKE_CURRENT_LIST_DIR}/onetbb.sh ${CMAKE_BINARY_DIR}/onetbb
  OUTPUT_VARIABLE said RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
if(failed)
  string(REGEX REPLACE ".*\n" "" PAIRSUM_NO_ONETBB "${said}")
  message(STATUS "No oneTBB for ThreadSanitizer, so its backends are not tested: ${PAIRSUM_NO_ONETBB}")
else()
  set(TBB_DIR ${CMAKE_BINARY_DIR}/onetbb/lib/cmake/TBB CACHE PATH "oneTBB for ThreadSanitizer" FORCE)
endif()
