# The program as a file of WebAssembly and the script that starts it, for a page (`make browser-lab`) and for node
# (packaging/browser/command.cjs). Stack and memory as far as a browser gives them.
set_target_properties(phyllite PROPERTIES SUFFIX .js)
target_link_options(phyllite PRIVATE -O2 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sINITIAL_MEMORY=64MB -sTOTAL_STACK=8MB
  -sEXIT_RUNTIME=1 -sINVOKE_RUN=0 -sMODULARIZE=1 -sEXPORT_NAME=phyllite -sENVIRONMENT=worker,node -sFORCE_FILESYSTEM=1 -lnodefs.js
  -sEXPORTED_FUNCTIONS=_main,_malloc,_free,_phyllite_answer
  -sEXPORTED_RUNTIME_METHODS=FS,NODEFS,callMain,HEAPU8,UTF8ToString,stringToUTF8,lengthBytesUTF8)
