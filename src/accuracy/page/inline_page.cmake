# Writes a page with its style sheets and scripts in it as a C++ string: cmake -DOUTPUT=file.cpp -DPAGE=page.html
# -DSTYLES=a.css,b.css -DSCRIPTS=a.js,b.js -DHEADER=folder/declares.hpp -DFUNCTION=name -P inline_page.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${PAGE}" page)
foreach(kind STYLE SCRIPT)
  string(REPLACE "," ";" files "${${kind}S}")
  set(joined "")
  foreach(file IN LISTS files)
    file(READ "${file}" text)
    string(APPEND joined "${text}")
  endforeach()
  string(REPLACE "@${kind}@" "${joined}" page "${page}")
endforeach()
file(WRITE "${OUTPUT}" "// Written by inline_page.cmake.
#include \"${HEADER}\"

std::string_view speculum::${FUNCTION}() {
  return R\"page(${page})page\";
}
")
