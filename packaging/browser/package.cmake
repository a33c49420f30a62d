# The program as a file of WebAssembly and the script that starts it, for a page (`make browser-lab`) and for node
# (packaging/browser/command.cjs). Stack and memory as far as a browser gives them. And once more with threads, for a page that
# may have them. The command is on a thread of its own too, so that the first is free for what only it can do: files, and to
# begin threads. One that waits for another looks for such wishes only once in a millisecond.
add_executable(phyllite_threads src/cli/main.cpp)
target_link_libraries(phyllite_threads PRIVATE verbs phyllite_core)
foreach(program phyllite phyllite_threads)
  set_target_properties(${program} PROPERTIES SUFFIX .js)
  target_compile_options(${program} PRIVATE ${PHY_QUICK} -DPHY_MAIN)
  target_link_options(${program} PRIVATE -O2 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sINITIAL_MEMORY=64MB -sTOTAL_STACK=8MB
    -sEXIT_RUNTIME=1 -sINVOKE_RUN=0 -sMODULARIZE=1 -sEXPORT_NAME=phyllite -sENVIRONMENT=worker,node -sFORCE_FILESYSTEM=1 -lnodefs.js
    -sEXPORTED_FUNCTIONS=_main,_malloc,_free,_phyllite_answer
    -sEXPORTED_RUNTIME_METHODS=FS,NODEFS,callMain,HEAPU8,UTF8ToString,stringToUTF8,lengthBytesUTF8)
endforeach()
target_link_options(phyllite_threads PRIVATE -pthread -sPROXY_TO_PTHREAD=1 -sPTHREAD_POOL_SIZE_STRICT=0
  -sDEFAULT_PTHREAD_STACK_SIZE=8MB -Wno-pthreads-mem-growth)
