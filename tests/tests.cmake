# Tests: one executable per room (label unit), one per folder of tests/ (its name is the label). What takes time is in the
# program; these only ask. What all of them include is parsed once.
add_library(count_events MODULE tests/count_events.cpp)  # loaded into the program to end it at a counted event
target_link_libraries(count_events PRIVATE ${CMAKE_DL_LIBS})
set(PHY_TEST_OPTIONS $<$<CONFIG:Release>:-Og> ${PHY_PRECOMPILED})
add_library(test_headers OBJECT EXCLUDE_FROM_ALL tests/test_headers.cpp)
target_link_libraries(test_headers PRIVATE fmt::fmt GTest::gtest GTest::gmock)
target_compile_options(test_headers PRIVATE ${PHY_TEST_OPTIONS})
target_precompile_headers(test_headers PRIVATE <fmt/format.h> <gmock/gmock.h> <gtest/gtest.h> <algorithm> <chrono>
                          <filesystem> <functional> <map> <memory> <mutex> <string> <vector>)
function(phy_test name labels)
  if(ARGN)
    add_executable(${name} ${ARGN})
    target_link_libraries(${name} PRIVATE phyllite_core GTest::gtest GTest::gmock GTest::gtest_main)
    target_compile_options(${name} PRIVATE ${PHY_TEST_OPTIONS})
    target_precompile_headers(${name} REUSE_FROM test_headers)
    target_compile_definitions(${name} PRIVATE PHY_SOURCE_DIR="${CMAKE_SOURCE_DIR}" PHY_PROGRAM="$<TARGET_FILE:phyllite>"
                               PHY_EVENTS="$<TARGET_FILE:count_events>")
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT ${PHY_TEST_TIMEOUT})
  endif()
endfunction()
file(GLOB PHY_ROOMS RELATIVE ${CMAKE_SOURCE_DIR}/src CONFIGURE_DEPENDS src/*)
foreach(room IN LISTS PHY_ROOMS)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS src/${room}/*.test.cpp)
  phy_test(test_${room} "unit$<$<STREQUAL:${room},laws>:;conform>" ${files})
endforeach()
add_dependencies(test_cli phyllite)
file(GLOB PHY_LABELS RELATIVE ${CMAKE_SOURCE_DIR}/tests CONFIGURE_DEPENDS tests/*)
foreach(label IN LISTS PHY_LABELS)
  file(GLOB files CONFIGURE_DEPENDS tests/${label}/*.cpp)
  phy_test(test_x_${label} ${label} ${files})
  if(files)
    add_dependencies(test_x_${label} phyllite count_events)
  endif()
endforeach()
# What reads ZIP archives is held against the library that writes these.
find_library(PHY_ZIP zip REQUIRED)  # libzip's own CMake files ask for programs of another package
target_link_libraries(test_io PRIVATE ${PHY_ZIP})
target_link_libraries(test_x_fuzz PRIVATE verbs ${PHY_ZIP})
add_dependencies(test_x_install manual)
target_compile_definitions(test_x_install PRIVATE $<$<CONFIG:Release>:PHY_GUARDED>)
set_tests_properties(test_x_soak PROPERTIES TIMEOUT 7200)
# The longest first, or one of them would hold up the end while other cores are idle.
set_tests_properties(test_calibrate test_x_cli test_x_calibration PROPERTIES COST 100)
find_library(PHY_NLOPT nlopt_cxx)  # for the comparison of calibrations; without it that file is left out
if(PHY_NLOPT)
  target_link_libraries(test_x_soak PRIVATE ${PHY_NLOPT})
  set_source_files_properties(tests/soak/comparison.test.cpp PROPERTIES COMPILE_DEFINITIONS PHY_NLOPT)
endif()

# The test of hashes alone with what it needs, for another compiler: a third of the program (make clang-hash).
set(PHY_HASHED ${PHY_SOURCES})
list(FILTER PHY_HASHED INCLUDE REGEX "/src/(base|records|contact|engine|genesis|lab|analysis|events|statics|system)/\
|/src/io/(ags|csv|deflate|disk|file|new_folder|output|scene|table|table_cells|table_layout|workbook|zip).cpp\
|/src/study/(design|direct|expected|experiment|lane_batch|plan|task_queue|work|worker).cpp|/src/theory/(goodman|jaeger).cpp|/src/verification/golden.cpp")
add_executable(one_hash EXCLUDE_FROM_ALL ${PHY_HASHED} ${PHY_KERNELS} tests/determinism/one_hash.test.cpp)
add_dependencies(one_hash version_of_build)
target_compile_definitions(one_hash PRIVATE PHY_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
target_link_libraries(one_hash PRIVATE common GTest::gtest GTest::gmock GTest::gtest_main)

# The rooms that read what comes from outside under the sanitizers, all others as usual: short enough for every push.
if(PHY_WATCH)
  set(PHY_LEFT ${PHY_SOURCES})
  # Eigen would allocate in another way under the sanitizer than in the files beside these, which free what it returns.
  phy_objects(watched "(base|records|io|rock)/" -O1 -g1 -U_FORTIFY_SOURCE -fsanitize=address,undefined
              -fno-sanitize-recover=undefined -DEIGEN_MALLOC_ALREADY_ALIGNED=1)
  foreach(test test_base test_records test_io test_rock test_x_fuzz)
    target_sources(${test} PRIVATE $<TARGET_OBJECTS:watched>)  # before those of the library, which are not taken then
    target_link_options(${test} PRIVATE -fsanitize=address,undefined)
    set_property(TEST ${test} APPEND PROPERTY LABELS watched)
  endforeach()
endif()
