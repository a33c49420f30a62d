# Libraries from the sources that tools/sources.sh has brought, for a machine whose libraries are not here.
enable_language(C)
set(CMAKE_C_FLAGS_RELEASE "-O2")
file(GLOB PHY_ZLIB ${PHY_LIBRARIES}/zlib/*.c)
list(FILTER PHY_ZLIB EXCLUDE REGEX "/gz[a-z]+\\.c$")  # its files, for which the program has its own
add_library(libraries STATIC ${PHY_ZLIB} ${PHY_LIBRARIES}/sqlite/sqlite3.c ${PHY_LIBRARIES}/pugixml/src/pugixml.cpp
            ${PHY_LIBRARIES}/fmt/src/format.cc)
target_include_directories(libraries SYSTEM PUBLIC ${PHY_LIBRARIES}/include ${PHY_LIBRARIES}/zlib ${PHY_LIBRARIES}/sqlite
                           ${PHY_LIBRARIES}/pugixml/src ${PHY_LIBRARIES}/fmt/include)
target_compile_definitions(libraries PRIVATE SQLITE_OMIT_LOAD_EXTENSION SQLITE_DQS=0)
target_compile_options(libraries PRIVATE -w)
foreach(name fmt::fmt Eigen3::Eigen nlohmann_json::nlohmann_json SQLite::SQLite3 ZLIB::ZLIB pugixml::pugixml)
  add_library(${name} INTERFACE IMPORTED)
  target_link_libraries(${name} INTERFACE libraries)
endforeach()
