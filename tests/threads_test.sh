#!/bin/sh
# The same bytes on any number of threads, on both backends and in both precisions. A process of its own for each picture:
# an OpenCL driver takes its number of threads once.
set -u

rectray=${RECTRAY:-build/rectray}
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
passed=0
failed=0

# same NAME OPTION...: renders with 1 to 4 threads and compares.
same()
{
    name=$1
    shift
    for threads in 1 2 3 4; do
        "$rectray" render tests/scenes/many_lights.json --size 97x131 --threads "$threads" --quiet "$@" \
            -o "$folder/$name-$threads.png" || { failed=$((failed + 1)); return; }
        if ! cmp "$folder/$name-1.png" "$folder/$name-$threads.png"; then
            echo "rectray render tests/scenes/many_lights.json --size 97x131 --threads $threads $*"
            failed=$((failed + 1))
            return
        fi
    done
    passed=$((passed + 1))
}

same reference --backend reference
same float --backend opencl --precision float
same double --backend opencl --precision double
same tree --backend opencl --accel bvh

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
