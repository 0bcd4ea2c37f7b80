# Sourced by the other scripts: what a fresh Debian 12 or 13 needs, and the function that installs what is missing.

build_packages=(
  build-essential cmake ninja-build ccache git pkg-config
  libvulkan-dev libglfw3-dev libglm-dev libimgui-dev libstb-dev libfreetype-dev
  glslang-tools spirv-tools
  libtinyobjloader-dev libtinygltf-dev libtinyexr-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libspdlog-dev
  libfmt-dev libtbb-dev libmeshoptimizer-dev
)
run_packages=(mesa-vulkan-drivers fonts-dejavu-core fontconfig)
test_packages=(
  vulkan-validationlayers libgtest-dev librapidcheck-dev libembree-dev
  xvfb x11-xkb-utils xdotool wmctrl x11-utils openbox util-linux python3
  chromium chromium-driver python3-selenium
)
# Debian 13 has later versions only, which format differently.
if [ "$(. /etc/os-release && echo "${VERSION_ID:-}")" = 12 ]; then
  test_packages+=(clang-format-14)
fi
# For the package (cpack -G DEB) and its check.
package_packages=(dpkg-dev file librsvg2-bin lintian)
# For scripts/bench-mirrors only.
bench_packages=(python3)
# For scripts/linux-archive only, with the build's.
archive_packages=(dpkg-dev xz-utils binutils zlib1g-dev libwayland-dev wayland-protocols libxkbcommon-dev libxrandr-dev
  libxinerama-dev libxcursor-dev libxi-dev)
# For scripts/windows only, with the build's; Xvfb and its tools are for --test.
windows_packages=(g++-mingw-w64-x86-64-posix libz-mingw-w64-dev dpkg-dev zip wine wine64 libgtest-dev googletest xvfb xdotool)
# For scripts/fuzz only.
fuzz_packages=(clang-14 libclang-rt-14-dev)

# For scripts/check_metrics only.
metrics_packages=(python3-skimage)

# Names on other systems: Debian's, Fedora's, Arch's and openSUSE's; commas join several, - is none that is needed or
# packaged.
other_names='
build-essential         gcc-c++                    base-devel                        gcc-c++
cmake                   cmake                      cmake                             cmake
ninja-build             ninja-build                ninja                             ninja
ccache                  ccache                     ccache                            ccache
git                     git                        git                               git
pkg-config              pkgconf-pkg-config         pkgconf                           pkgconf-pkg-config
libvulkan-dev           vulkan-headers,vulkan-loader-devel vulkan-headers,vulkan-icd-loader vulkan-headers,vulkan-devel
libglfw3-dev            glfw-devel                 glfw                              libglfw-devel
libglm-dev              glm-devel                  glm                               glm-devel
libimgui-dev            imgui-devel                -                                 imgui-devel
libstb-dev              stb-devel                  stb                               stb-devel
libfreetype-dev         freetype-devel             freetype2                         freetype2-devel
glslang-tools           glslang                    glslang                           glslang-devel
spirv-tools             spirv-tools                spirv-tools                       spirv-tools
libtinyobjloader-dev    tinyobjloader-devel        -                                 tinyobjloader-devel
libtinyexr-dev          tinyexr-devel              -                                 -
libtomlplusplus-dev     tomlplusplus-devel         tomlplusplus                      tomlplusplus-devel
nlohmann-json3-dev      json-devel                 nlohmann-json                     nlohmann_json-devel
libcli11-dev            cli11-devel                cli11                             cli11-devel
libspdlog-dev           spdlog-devel               spdlog                            spdlog-devel
libfmt-dev              fmt-devel                  fmt                               fmt-devel
libtbb-dev              tbb-devel                  onetbb                            tbb-devel
libmeshoptimizer-dev    meshoptimizer-devel        -                                 meshoptimizer-devel
libtinygltf-dev         tinygltf-devel             -                                 -
mesa-vulkan-drivers     mesa-vulkan-drivers        vulkan-swrast                     libvulkan_lvp
fonts-dejavu-core       dejavu-sans-fonts          ttf-dejavu                        dejavu-fonts
fontconfig              fontconfig                 fontconfig                        fontconfig
vulkan-validationlayers vulkan-validation-layers   vulkan-validation-layers          vulkan-validationlayers
libgtest-dev            gtest-devel                gtest                             gtest
librapidcheck-dev       rapidcheck-devel           rapidcheck                        -
libembree-dev           embree-devel               embree                            embree-devel
xvfb                    xorg-x11-server-Xvfb       xorg-server-xvfb                  xorg-x11-server-Xvfb
x11-xkb-utils           xkbcomp                    xorg-xkbcomp                      xkbcomp
x11-utils               xprop                      xorg-xprop                        xprop
chromium-driver         chromedriver               -                                 chromedriver
python3                 python3                    python                            python3
python3-selenium        python3-selenium           python-selenium                   python3-selenium
'

# Prints, on a system without apt-get, the command that installs what is missing of the packages, and fails; succeeds if
# nothing is. Packages without a name in the table keep Debian's.
advise_missing() {
  local command query column missing=() package name
  if command -v dnf >/dev/null; then
    command='dnf install' query='rpm -q' column=2
  elif command -v pacman >/dev/null; then
    command='pacman -S --needed' query='pacman -Q' column=3
  elif command -v zypper >/dev/null; then
    command='zypper install' query='rpm -q' column=4
  else
    echo "The packages for this system are not known; Debian calls what is needed $*" >&2
    return 0
  fi
  for package in "$@"; do
    name=$(awk -v package="$package" -v column=$column '$1 == package { print $column }' <<<"$other_names")
    for name in $(tr , ' ' <<<"${name:-$package}"); do
      [ "$name" = - ] || $query "$name" >/dev/null 2>&1 || missing+=("$name")
    done
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  echo "Packages are missing. As root: $command ${missing[*]}" >&2
  echo "(These names were not tried. CMake names what is still missing; IMGUI_DIR takes Dear ImGui's sources.)" >&2
  return 1
}

# install_missing PACKAGE...: silent when everything is there. Without apt-get it says what to install.
install_missing() {
  local missing=() package
  if ! command -v apt-get >/dev/null; then
    advise_missing "$@"
    return
  fi
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}
