# Sourced by scripts/windows and scripts/linux-archive: static libraries for an archive that runs without any package. And
# by scripts/release, for the version.
# Expects `root` and `build` (the build tree).
deps=$build/deps
libraries=(fmtlib spdlog meshoptimizer onetbb tinygltf tinyexr tinyobjloader libstb imgui)

# get_sources SUITE PACKAGE...: unpacks the sources of Debian packages into $build/sources/NAME. Only the lists of these
# sources are its own.
get_sources() {
  local suite=$1 into=$build/sources lists=$build/sources/lists package file wanted=()
  shift
  for package in "$@"; do
    [ -e "$into/$package/debian/copyright" ] || wanted+=("$package")
  done
  [ ${#wanted[@]} -eq 0 ] && return 0
  rm -rf "$lists"
  mkdir -p "$lists"/{state/lists/partial,cache/archives/partial,parts}
  echo "Types: deb-src
URIs: http://deb.debian.org/debian
Suites: $suite
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg" >"$lists/parts/debian.sources"
  local apt=(apt-get -qq -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$lists/parts"
    -o Dir::State="$lists/state" -o Dir::State::Status=/var/lib/dpkg/status -o Dir::Cache="$lists/cache"
    -o Debug::NoLocking=1 -o APT::Sandbox::User="$(id -un)")
  "${apt[@]}" update
  (cd "$into" && "${apt[@]}" source --download-only "${wanted[@]}")
  for package in "${wanted[@]}"; do
    file=$(echo "$into/$package"_*.dsc)
    rm -rf "${into:?}/$package"
    dpkg-source -q --no-check --extract "$file" "$into/$package"
  done
  rm -rf "$lists"
}

# build_library NAME OPTION...: builds it static and installs it into $build/deps. `toolchain` holds options for all.
build_library() {
  local name=$1
  shift
  [ -f "$deps/built/$name" ] && return 0
  echo "Building $name"
  local folder=$build/libraries/$name
  cmake -S "$build/sources/$name" -B "$folder" -G Ninja "${toolchain[@]}" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_INSTALL_PREFIX="$deps" -DCMAKE_INSTALL_LIBDIR=lib -DBUILD_SHARED_LIBS=OFF \
    -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache "$@" \
    >"$folder.log"
  cmake --build "$folder" >>"$folder.log"
  cmake --install "$folder" >>"$folder.log"
  touch "$deps/built/$name"
}

# get_libraries GLFW-SUITE: everything but what one system alone needs. GLFW may be of a later Debian than the rest.
get_libraries() {
  mkdir -p "$deps"/{built,include,lib,licences} "$build/libraries"
  get_sources bookworm "${libraries[@]}"
  get_sources "$1" glfw3
  # Headers that need no code are the host's.
  local header package
  for header in glm toml++ nlohmann CLI vulkan vk_video; do
    ln -sfn "/usr/include/$header" "$deps/include/$header"
    package=$(dpkg-query -S "/usr/include/$header" | head -1 | sed 's/[:,].*//')
    cp "/usr/share/doc/$package/copyright" "$deps/licences/$package.txt"
  done
  for package in "${libraries[@]}" glfw3; do
    cp "$build/sources/$package/debian/copyright" "$deps/licences/$package.txt"
  done
  cp -p "$build"/sources/{libstb/stb_image*,libstb/stb_truetype,tinyobjloader/tiny_obj_loader,tinygltf/tiny_gltf}.h "$deps/include"
  build_library fmtlib -DFMT_TEST=OFF -DFMT_DOC=OFF
  build_library spdlog -DSPDLOG_FMT_EXTERNAL=ON -DSPDLOG_BUILD_EXAMPLE=OFF
  build_library glfw3 -DGLFW_BUILD_EXAMPLES=OFF -DGLFW_BUILD_TESTS=OFF -DGLFW_BUILD_DOCS=OFF
  build_library meshoptimizer
  build_library onetbb -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF
  sed -i 's/ SHARED / /' "$build/sources/tinyexr/CMakeLists.txt"
  build_library tinyexr -DBUILD_TESTING=OFF
}

# The version of the program, and the time that everything in an archive bears: two builds of a commit give the same
# bytes.
version=$(sed -n 's/^project(speculum VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
SOURCE_DATE_EPOCH=$(git -C "$root" log -1 --format=%ct)
export SOURCE_DATE_EPOCH

# stage NAME: installs the program into $build/NAME, with the licences of what it holds.
stage() {
  rm -rf "${build:?}/$1"
  cmake --install "$build" --prefix "$build/$1" --strip >/dev/null
  cp -r "$deps/licences" "$build/$1/licences"
  chmod -R u=rwX,go=rX "$build/$1"
  find "$build/$1" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
}
