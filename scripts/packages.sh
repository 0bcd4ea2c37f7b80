# Sourced by the other scripts: what a fresh Debian 12 or 13 needs, and the function that installs what is missing.

build_packages=(
  build-essential cmake ninja-build ccache git pkg-config
  libvulkan-dev libglfw3-dev libglm-dev libimgui-dev libstb-dev libfreetype-dev
  glslang-tools spirv-tools
  libtinyobjloader-dev libtinyexr-dev libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libspdlog-dev libfmt-dev
  libtbb-dev libmeshoptimizer-dev
)
run_packages=(mesa-vulkan-drivers fonts-dejavu-core)
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
# For scripts/fuzz only.
fuzz_packages=(clang-14 libclang-rt-14-dev)

# For scripts/check_metrics only.
metrics_packages=(python3-skimage)

# install_missing PACKAGE...: silent when everything is there.
install_missing() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  if ! command -v apt-get >/dev/null; then
    echo "These packages are missing and there is no apt-get to install them: ${missing[*]}" >&2
    return 1
  fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}
