# A test that runs `urdd lint`, for CTest and for ament. Copy this file into your package.
#
#   include(cmake/UrddLint.cmake)
#   urdd_add_lint_test(lint_urdf urdf/arm.urdf urdf/gripper.urdf ARGUMENTS --fail-on warning)
#
# The first word is the test's name; then come files and folders, relative to the current source folder. ARGUMENTS are
# passed on. The test fails for findings at or above --fail-on. Its report is written as JUnit where `colcon test-result`
# looks for it, or below the build folder. Set URDD_PROGRAM where `urdd` is not on PATH.

cmake_minimum_required(VERSION 3.16)

function(urdd_add_lint_test name)
  cmake_parse_arguments(PARSE_ARGV 1 lint "" "" "ARGUMENTS")
  if(NOT lint_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "urdd_add_lint_test(${name}): name the files or folders to check")
  endif()
  find_program(URDD_PROGRAM urdd DOC "The program urdd, 1.1.0 or later")
  if(NOT URDD_PROGRAM)
    message(FATAL_ERROR "urdd_add_lint_test(${name}): urdd is not on PATH; run `pip install urdd`, or set URDD_PROGRAM")
  endif()
  foreach(path IN LISTS lint_UNPARSED_ARGUMENTS)
    if(NOT EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${path}" AND NOT EXISTS "${path}")
      message(FATAL_ERROR "urdd_add_lint_test(${name}): ${path} does not exist")
    endif()
  endforeach()
  if(AMENT_TEST_RESULTS_DIR)
    set(folder "${AMENT_TEST_RESULTS_DIR}/${PROJECT_NAME}")
  else()
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/test_results")
  endif()
  file(MAKE_DIRECTORY "${folder}")
  add_test(
    NAME "${name}"
    COMMAND "${URDD_PROGRAM}" lint ${lint_UNPARSED_ARGUMENTS} --output "${folder}/${name}.xunit.xml" ${lint_ARGUMENTS}
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
  )
  set_tests_properties("${name}" PROPERTIES LABELS "urdd;linter")
endfunction()
