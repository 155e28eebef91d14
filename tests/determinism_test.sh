#!/bin/sh
# The same bytes each time: on any number of threads, on both backends and in both precisions, and in double with any
# number of lanes; sampled adaptively, too. Each picture is made by a process of its own, for an OpenCL driver takes its
# number of threads once.
set -u

rectray=${RECTRAY:-build/rectray}
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
runs=10
[ "${RECTRAY_SOAK:-}" = 1 ] && runs=100
passed=0
failed=0

# picture NAME OPTION...: renders; is the first picture of that name, or must be equal to it.
picture()
{
    name=$1
    shift
    "$rectray" render tests/scenes/many_lights.json --size 97x131 --quiet "$@" -o "$folder/new.png" || return 1
    if [ ! -e "$folder/$name.png" ]; then
        mv "$folder/new.png" "$folder/$name.png"
    elif ! cmp "$folder/$name.png" "$folder/new.png"; then
        echo "rectray render tests/scenes/many_lights.json --size 97x131 $*"
        return 1
    fi
}

# each NAME OPTION VALUES OPTION...: the pictures of one name are the same with every value of the option.
each()
{
    name=$1 option=$2 values=$3
    shift 3
    for value in $values; do
        picture "$name" "$option" "$value" "$@" || { failed=$((failed + 1)); return; }
    done
    passed=$((passed + 1))
}

threads="1 2 3 4 5 6 7 8"
each double --threads "$threads" --backend reference
each double --threads "$threads" --precision double
each float --threads "$threads" --precision float
each tree --threads "$threads" --precision float --accel bvh
each double --lanes "1 4 8 16" --precision double
each double --lanes "1 4 8 16" --precision double --accel bvh
each double --lanes "1 4 8 16" --precision double --accel kdtree
each adaptive --threads "$threads" --backend reference --sampling adaptive:4
each adaptive --threads "$threads" --precision double --sampling adaptive:4
each adaptive --lanes "1 4 8 16" --precision double --sampling adaptive:4 --accel bvh
each adaptive_float --threads "$threads" --precision float --sampling adaptive:4
again=$(yes 2 | head -n $runs)
each double --threads "$again" --backend reference
each double --threads "$again" --precision double
each float --threads "$again" --precision float

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
