# The Python package: the module beside the files of python/phyllite, where its tests find it; `make python` installs it.
if(PHY_PYTHON)
  find_program(Python3_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)  # Debian's, whose NumPy it is
  find_package(Python3 COMPONENTS Interpreter Development.Module NumPy QUIET)
  find_path(PHY_PYBIND11 pybind11/pybind11.h)
endif()
if(PHY_PYTHON AND Python3_Development.Module_FOUND AND Python3_NumPy_FOUND AND PHY_PYBIND11)
  file(GLOB PHY_MODULE CONFIGURE_DEPENDS src/python/*.cpp)
  file(GLOB PHY_PYTHON_FILES CONFIGURE_DEPENDS python/phyllite/*)
  Python3_add_library(phyllite_python MODULE WITH_SOABI ${PHY_MODULE})
  target_link_libraries(phyllite_python PRIVATE phyllite_core)
  target_compile_options(phyllite_python PRIVATE ${PHY_QUICK})
  # Its elementary functions are its own (src/base/libm.cpp), though Python has loaded the C library's before.
  target_link_options(phyllite_python PRIVATE -Wl,-Bsymbolic)
  set_target_properties(phyllite_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/phyllite)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/python/phyllite)  # else the first file would take its name
  foreach(file IN LISTS PHY_PYTHON_FILES)
    configure_file(${file} python/phyllite/ COPYONLY)
  endforeach()
  install(TARGETS phyllite_python LIBRARY DESTINATION phyllite COMPONENT python EXCLUDE_FROM_ALL)
  install(FILES ${PHY_PYTHON_FILES} DESTINATION phyllite COMPONENT python EXCLUDE_FROM_ALL)
  add_test(NAME test_x_python COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tests/python/run.py)
  set_tests_properties(test_x_python PROPERTIES TIMEOUT ${PHY_TEST_TIMEOUT} ENVIRONMENT
    "PYTHONPATH=${CMAKE_BINARY_DIR}/python;PHY_PROGRAM=$<TARGET_FILE:phyllite>;PHY_SOURCE_DIR=${CMAKE_SOURCE_DIR}")
else()
  add_test(NAME test_x_python COMMAND sh ${CMAKE_SOURCE_DIR}/tests/python/absent.sh)
endif()
set_tests_properties(test_x_python PROPERTIES LABELS python SKIP_RETURN_CODE 77)
