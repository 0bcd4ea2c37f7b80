# Writes the report's page with its style sheet and scripts in it as a C++ string:
# cmake -DOUTPUT=file.cpp -DPAGE=report.html -DSTYLE=report.css -DSCRIPTS=a.js,b.js -P inline_page.cmake
cmake_minimum_required(VERSION 3.25)
file(READ "${PAGE}" page)
file(READ "${STYLE}" style)
string(REPLACE "," ";" scripts "${SCRIPTS}")
set(script "")
foreach(file IN LISTS scripts)
  file(READ "${file}" text)
  string(APPEND script "${text}")
endforeach()
string(REPLACE "@STYLE@" "${style}" page "${page}")
string(REPLACE "@SCRIPT@" "${script}" page "${page}")
file(WRITE "${OUTPUT}" "// Written by inline_page.cmake.
#include \"accuracy/report.hpp\"

std::string_view speculum::reportPage() {
  return R\"page(${page})page\";
}
")
