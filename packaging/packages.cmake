# What `make install` and `make package` put where. Component `program`: the program, its manual pages, completion, documents,
# examples; `debian`: what Debian's policy asks of a package besides.
include(GNUInstallDirs)
set(PHY_SHARE ${CMAKE_BINARY_DIR}/share)
add_custom_command(OUTPUT ${PHY_SHARE}/completion.fish
  COMMAND sh ${CMAKE_SOURCE_DIR}/packaging/manual.sh $<TARGET_FILE:phyllite> ${PHY_SHARE}
  DEPENDS phyllite ${CMAKE_SOURCE_DIR}/packaging/manual.sh VERBATIM)
add_custom_target(manual ALL DEPENDS ${PHY_SHARE}/completion.fish)

set(PHY_DOC ${CMAKE_INSTALL_DATADIR}/doc/phyllite)
install(TARGETS phyllite RUNTIME COMPONENT program)
install(DIRECTORY ${PHY_SHARE}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${PHY_SHARE}/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME phyllite COMPONENT program)
install(FILES ${PHY_SHARE}/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        RENAME phyllite.fish COMPONENT program)
# Debian's zsh looks into vendor-completions of /usr, and into site-functions of /usr/local.
install(CODE [[if(CMAKE_INSTALL_PREFIX MATCHES "/usr/?$")
  set(PHY_ZSH vendor-completions)
else()
  set(PHY_ZSH site-functions)
endif()]] COMPONENT program)
install(FILES ${PHY_SHARE}/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/\${PHY_ZSH} RENAME _phyllite
        COMPONENT program)
install(FILES README.md CONTRIBUTING.md CITATION.cff packaging/copyright DESTINATION ${PHY_DOC} COMPONENT program)
install(DIRECTORY docs examples measured DESTINATION ${PHY_DOC} COMPONENT program)
install(DIRECTORY data/rocks DESTINATION ${PHY_DOC}/data COMPONENT program)

# Who stands for a package: as Debian's tools ask for it, DEBFULLNAME and DEBEMAIL.
set(PHY_MAINTAINER "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if(NOT PHY_MAINTAINER MATCHES "^.+ <.+@.+>$")
  set(PHY_MAINTAINER "The Phyllite authors <root@localhost>")
endif()
execute_process(COMMAND date --utc --rfc-email --date ${PHY_DATE} OUTPUT_VARIABLE PHY_RFC_DATE OUTPUT_STRIP_TRAILING_WHITESPACE)
set(PHY_DEBIAN ${CMAKE_BINARY_DIR}/debian)
string(REPLACE - ~ PHY_PACKAGE_VERSION ${PROJECT_VERSION}${PHY_DEV})  # before the release, as Debian counts
file(WRITE ${PHY_DEBIAN}/changelog "phyllite (${PHY_PACKAGE_VERSION}-1) unstable; urgency=medium

  * Package of version ${PHY_PACKAGE_VERSION}; what changed stands in changelog.gz.

 -- ${PHY_MAINTAINER}  ${PHY_RFC_DATE}
")
execute_process(COMMAND gzip -9n INPUT_FILE ${PHY_DEBIAN}/changelog OUTPUT_FILE ${PHY_DEBIAN}/changelog.Debian.gz)
execute_process(COMMAND gzip -9n INPUT_FILE ${CMAKE_SOURCE_DIR}/CHANGELOG.md OUTPUT_FILE ${PHY_DEBIAN}/changelog.gz)
install(FILES ${PHY_DEBIAN}/changelog.Debian.gz ${PHY_DEBIAN}/changelog.gz DESTINATION ${PHY_DOC} COMPONENT debian EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME phyllite)
set(CPACK_PACKAGE_VERSION ${PHY_PACKAGE_VERSION})
set(CPACK_PACKAGE_CONTACT ${PHY_MAINTAINER})
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR})
set(CPACK_COMPONENTS_ALL program debian)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gnuplot-nox | gnuplot, fonts-dejavu-core, ffmpeg")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "laboratory for layered rock (discrete elements)")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
  "Bonded-particle models of shale, slate, schist and gneiss in two dimensions:
discs held by parallel bonds or flat joints, bedding planes as smooth joints.
Runs uniaxial and biaxial compression, direct tension, Brazilian test, direct
shear and semi-circular bend on such specimens, parameter studies over many
cores and machines, and calibrates micro-parameters from the table of a
laboratory, with intervals and a verification on unseen packings.
.
Results are the same bits by every instruction set; the fastest one of the
processor (SSE2, AVX2, AVX-512) is chosen at run time. gnuplot is needed for
phyllite figure, ffmpeg for phyllite film.")
include(CPack)
