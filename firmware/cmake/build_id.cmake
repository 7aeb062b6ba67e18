# cmake -D SOURCES=<folder> -D OUTPUT=<file> -P build_id.cmake: writes link::build_id(), the hash of all sources below the
# folder. Paths are relative and sorted, so that it is the same wherever the project lies.
file(GLOB_RECURSE files RELATIVE ${SOURCES} ${SOURCES}/*.hpp ${SOURCES}/*.cpp)
list(SORT files)
set(all "")
foreach(file ${files})
  file(SHA256 ${SOURCES}/${file} hash)
  string(APPEND all "${hash} ${file}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 id)
file(WRITE ${OUTPUT}
     "#include \"firmtouch/link/build_id.hpp\"\n\n"
     "namespace firmtouch::link {\n\nuint64_t build_id() { return 0x${id}ull; }\n\n}  // namespace firmtouch::link\n")
