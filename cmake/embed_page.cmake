# Writes the files of the preview page as a C++ file: they are part of the program.
#   cmake -D OUTPUT=<file.cpp> -D DIRECTORY=<folder> -P embed_page.cmake
# A raw string may be 64 KiB at most everywhere; longer files go in pieces, which the compiler joins.
set(code "#include \"runtime/watch/pages.hpp\"\n\nnamespace scenec::runtime {\n\nnamespace {\n")
string(APPEND code "constexpr PageFile files[] = {\n")
foreach(row "/|index.html|text/html" "/page.css|page.css|text/css" "/page.js|page.js|text/javascript"
            "/draw.js|draw.js|text/javascript" "/controls.js|controls.js|text/javascript" "/camera.js|camera.js|text/javascript"
            "/params.js|params.js|text/javascript"
            "/icon.svg|icon.svg|image/svg+xml")
  string(REPLACE "|" ";" parts "${row}")
  list(GET parts 0 path)
  list(GET parts 1 name)
  list(GET parts 2 type)
  file(READ "${DIRECTORY}/${name}" text)
  if(text MATCHES "\\)scenec\"")
    message(FATAL_ERROR "${name} holds the text that ends a raw string")
  endif()
  if(NOT type MATCHES "svg")
    string(APPEND type "; charset=utf-8")
  endif()
  string(APPEND code "    {\"${path}\", \"${type}\",\n")
  string(LENGTH "${text}" left)
  set(at 0)
  while(at LESS left)
    string(SUBSTRING "${text}" ${at} 8000 piece)
    string(APPEND code "R\"scenec(${piece})scenec\"\n")
    math(EXPR at "${at} + 8000")
  endwhile()
  string(APPEND code "    },\n")
endforeach()
string(APPEND code "};\n}  // namespace\n\n")
string(APPEND code "std::span<const PageFile> page_files() {\n  return files;\n}\n\n")
string(APPEND code "}  // namespace scenec::runtime\n")
file(WRITE "${OUTPUT}" "${code}")
