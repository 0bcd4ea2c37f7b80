#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// What the tokens of an OBJ file say that its parser would pass over: it reads `nan` as 0 and accepts any index.
struct ObjScan {
  std::vector<bool> finitePosition;  // of the k-th v line; a w or a vertex colour does not count
  std::vector<bool> finiteTexcoord;  // of the k-th vt line
  std::vector<bool> finiteNormal;    // of the k-th vn line
  // What the parser is to see, line by line: v, vt, vn and f lines reduced to what is used of them and with numbers
  // that it can take, because it takes a comment behind them for more of the same; usemtl and mtllib lines; nothing
  // else.
  std::string text;
};

// Throws InputError for a malformed number, an index out of range, a face with fewer than 3 vertices, or bytes that are
// not text. `file` only serves messages. `progress` is told the share that is done, now and then; what it throws ends
// the scan.
ObjScan scanObj(const std::filesystem::path& file, std::string_view text,
                const std::function<void(double)>& progress = {});

// What messages about a material need: where in its file it stands.
struct MtlLines {
  int newmtl = 0;
  int mapKd = 0;  // 0: none
};

struct MtlScan {
  std::map<std::string, MtlLines> lines;  // by material name, the last one of a name
  std::string text;                       // what the parser is to see
};

// Checks the numbers of Kd, Ks, Ke, Ns, d and Tr, and that there are at most 10 000 materials; throws InputError.
MtlScan scanMtl(const std::filesystem::path& file, std::string_view text);

// Without leading and trailing blanks.
std::string_view trimmed(std::string_view text);

}  // namespace speculum
