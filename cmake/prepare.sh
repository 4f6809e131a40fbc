# shellcheck shell=bash
# What ./run and ./test have in common. Sourced by them; everything it says goes to stderr, because
# stdout belongs to the program.

say() { printf 'weft: %s\n' "$*" >&2; }
die() {
    say "$*"
    exit 1
}

# packages_in FILE…: the names in package lists, without comments.
packages_in() { sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$@"; }

# missing_packages NAME…: those of them that are not installed, one a line.
missing_packages() {
    local name installed
    installed=$(LC_ALL=C dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null |
        awk '$2 == "installed" { print $1 }' | sort -u) || true
    for name in "$@"; do
        grep -qxF -- "$name" <<<"$installed" || printf '%s\n' "$name"
    done
}

# install_packages LIST…: installs what is missing of the package lists; does nothing when all is there.
install_packages() {
    local -a wanted missing as_root=()
    mapfile -t wanted < <(packages_in "$@")
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        say "This is not a Debian system, so nothing is installed. Weft needs the equivalents of:"
        say "  ${wanted[*]}"
        for tool in cmake ninja c++ pkg-config; do
            command -v "$tool" >/dev/null || die "$tool is missing; install it and start again"
        done
        return
    fi
    mapfile -t missing < <(missing_packages "${wanted[@]}")
    ((${#missing[@]})) || return 0
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            die "Packages are missing and there is no sudo. As root: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    say "Installing ${#missing[@]} packages: ${missing[*]}"
    "${as_root[@]}" apt-get update -q >&2 || say "apt-get update failed; trying with the lists that are there"
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
        "${missing[@]}" >&2 || die "The packages could not be installed; see apt-get's message above"
}

# build_jobs: how many compilers fit, one a core and one for each 1.5 GB of free memory.
build_jobs() {
    local cores memory_mb jobs
    cores=$(nproc 2>/dev/null || echo 1)
    memory_mb=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo 2>/dev/null || true)
    jobs=$cores
    if [[ -n $memory_mb ]] && ((memory_mb / 1500 < jobs)); then jobs=$((memory_mb / 1500)); fi
    echo $((jobs > 0 ? jobs : 1))
}

# test_jobs: how many tests run side by side, one for two cores and for each 2 GB of free memory, two at least: tests
# compute with several threads, and some wait for what they show.
test_jobs() {
    local cores memory_mb jobs
    cores=$(nproc 2>/dev/null || echo 1)
    memory_mb=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo 2>/dev/null || true)
    jobs=$((cores / 2))
    if [[ -n $memory_mb ]] && ((memory_mb / 2000 < jobs)); then jobs=$((memory_mb / 2000)); fi
    echo $((jobs > 2 ? jobs : 2))
}

# One compiler cache for every clone: objects are found by what they are made of, not by where they lie.
# Sources whose headers are precompiled are cached only with this sloppiness.
use_compiler_cache() {
    export CCACHE_BASEDIR=$1 CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
}

# best_cpu: the value of WEFT_CPU for a build that stays on this machine, as the C library judges it.
best_cpu() {
    local loader=/lib64/ld-linux-x86-64.so.2
    if [[ -x $loader ]] && "$loader" --help 2>/dev/null | grep -q 'x86-64-v3 (supported'; then
        echo x86-64-v3
    fi
}

# configure ROOT PRESET [CPU]: configures the tree of a preset where that is needed.
configure() {
    local root=$1 preset=$2 cpu=${3-} tree=$1/build/$2
    use_compiler_cache "$root"
    if [[ -f $tree/build.ninja && ! $root/CMakePresets.json -nt $tree/build.ninja ]] &&
        grep -qx "WEFT_CPU:STRING=$cpu" "$tree/CMakeCache.txt" 2>/dev/null; then return; fi
    say "Configuring $tree"
    # A preset is found from the current folder.
    (cd "$root" && cmake --preset "$preset" -DWEFT_CPU="$cpu") >&2 || die "CMake failed; see its message above"
}

# minutes SECONDS: as 2:05.
minutes() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

# show_build_progress: reads what ninja prints with NINJA_STATUS=@%f/%t@ and shows its steps as one line that moves, or
# without a terminal as a line after every tenth of the work; passes on all else, which is what compilers say.
show_build_progress() {
    local line started=$SECONDS done_steps all_steps gone left tenth last_tenth=0 moving=0
    while IFS= read -r line; do
        if [[ ! $line =~ ^@([0-9]+)/([0-9]+)@ ]]; then
            [[ $line == "ninja: Entering directory"* ]] && continue
            ((moving)) && printf '\n' >&2
            moving=0
            printf '%s\n' "$line" >&2
            continue
        fi
        done_steps=${BASH_REMATCH[1]} all_steps=${BASH_REMATCH[2]}
        ((done_steps > 0)) || continue  # CMake runs again first
        gone=$((SECONDS - started))
        left=$((gone * (all_steps - done_steps) / done_steps))
        line="weft: step $done_steps of $all_steps, $(minutes $gone) gone, about $(minutes $left) left"
        tenth=$((done_steps * 10 / all_steps))
        if [[ -t 2 ]]; then
            printf '\r\033[K%s' "$line" >&2
            moving=1
        elif ((tenth > last_tenth)); then
            printf '%s\n' "$line" >&2
        fi
        last_tenth=$tenth
    done
    ((moving)) && printf '\n' >&2
    return 0
}

# build ROOT PRESET TARGET [CPU]: configures where needed and builds; says nothing when all is up to date.
build() {
    local root=$1 preset=$2 target=$3 cpu=${4-} tree=$1/build/$2
    configure "$root" "$preset" "$cpu"
    if LC_ALL=C ninja -C "$tree" -n "$target" 2>/dev/null | grep -q 'no work to do'; then return; fi
    local jobs
    jobs=$(build_jobs)
    say "Building with $jobs jobs"
    # With pipefail, as every script that sources this sets it.
    NINJA_STATUS='@%f/%t@' ninja -C "$tree" -j "$jobs" "$target" 2>&1 | show_build_progress ||
        die "The build failed; see the compiler's messages above"
}

# on_each_core COMMAND ARGUMENT…: calls it with each argument, as many at a time as there are cores; exits with the first
# that fails, and stops the others.
on_each_core() {
    local command=$1 argument running=0 cores
    cores=$(nproc 2>/dev/null || echo 1)
    shift
    trap 'kill $(jobs -p) 2>/dev/null || true' EXIT
    for argument in "$@"; do
        if ((running == cores)); then
            wait -n || exit 1
            running=$((running - 1))
        fi
        "$command" "$argument" &
        running=$((running + 1))
    done
    for (( ; running > 0; --running)); do wait -n || exit 1; done
    trap - EXIT
}

# make_starter_library ROOT TREE: the starter textures as a library beside the program, which a user's
# first start copies. Made again where their sources changed.
make_starter_library() {
    local sources=$1/texture_db/starter weft=$2/bin/weft starter=$2/share/weft/starter.db
    if [[ -f $starter && -z $(find "$sources" -newer "$starter" -print -quit) ]]; then return; fi
    say "Making the starter textures"
    rm -f "$starter"*
    if "$weft" texture build --packages none --db "$starter.part" >&2; then
        mv "$starter.part" "$starter"
    else
        say "They could not be made; Weft makes them when they are first wanted"
    fi
}
