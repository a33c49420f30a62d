# What Windows asks of the program, and the archive for its users (`make windows`).
enable_language(RC)
target_sources(phyllite PRIVATE packaging/windows/phyllite.rc)
target_link_options(phyllite PRIVATE LINKER:--stack,8388608)  # as elsewhere, also of its threads

set(CPACK_GENERATOR ZIP)
set(CPACK_PACKAGE_FILE_NAME phyllite-${PROJECT_VERSION}${PHY_DEV}-windows)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR})
configure_file(packaging/windows/README.txt README.txt @ONLY NEWLINE_STYLE CRLF)
install(TARGETS phyllite RUNTIME DESTINATION .)
install(FILES ${CMAKE_BINARY_DIR}/README.txt DESTINATION .)
install(FILES packaging/copyright DESTINATION licences RENAME phyllite.txt)
foreach(library zlib sqlite3 pugixml fmtlib)  # which it contains
  file(GLOB file ${PHY_LIBRARIES}/${library}-*/debian/copyright)
  install(FILES ${file} DESTINATION licences RENAME ${library}.txt)
endforeach()
foreach(package gcc-mingw-w64-base mingw-w64-common)
  install(FILES /usr/share/doc/${package}/copyright DESTINATION licences RENAME ${package}.txt)
endforeach()
install(DIRECTORY examples DESTINATION .)
install(DIRECTORY data/rocks DESTINATION data)  # whose tables examples name
include(CPack)
