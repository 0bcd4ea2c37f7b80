# Sourced by check-hard-cases and hard-case-pictures, which set `root`: a worktree of the last commit, in which the
# patches of tests/hard_cases/mutations put the naive method in the place of a stable one.

patches=$root/tests/hard_cases/mutations

make_naive_tree() {
  scratch=$(mktemp -d)
  tree=$scratch/speculum
  trap 'git -C "$root" worktree remove --force "$tree" 2>/dev/null; rm -rf "$scratch"' EXIT
  git -C "$root" worktree add --quiet --detach "$tree" HEAD
  export CCACHE_BASEDIR=$tree CCACHE_NOHASHDIR=1 TEST_TMPDIR=$scratch/ LP_NATIVE_VECTOR_WIDTH=128
  cmake -S "$tree" --preset ci >"$scratch/build.log" || { cat "$scratch/build.log" >&2; return 1; }
}

# field KEY PATCH: a line of the patch's head.
field() { sed -n "s/^$1: //p" "$tree/tests/hard_cases/mutations/$2.patch"; }

# build TARGET...
build() {
  if ! cmake --build "$tree/build/ci" --target "$@" >"$scratch/build.log" 2>&1; then
    tail -30 "$scratch/build.log" >&2
    return 1
  fi
}

apply_naive() { git -C "$tree" apply "tests/hard_cases/mutations/$1.patch"; }
revert_naive() { git -C "$tree" apply -R "tests/hard_cases/mutations/$1.patch"; }
