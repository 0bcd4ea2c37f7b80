# Sourced by check-hard-cases and hard-case-pictures, which set `root`: a worktree of the last commit, in which the
# patches of tests/hard_cases/mutations put the naive method in the place of a stable one. It stays in build/naive, so
# that the next run compiles only what has changed.

patches=$root/tests/hard_cases/mutations
tree=$root/build/naive

make_naive_tree() {
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  if [ -e "$tree/.git" ]; then
    git -C "$tree" checkout --quiet --detach --force "$(git -C "$root" rev-parse HEAD)"
  else
    git -C "$root" worktree prune
    git -C "$root" worktree add --quiet --detach "$tree" HEAD
  fi
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
