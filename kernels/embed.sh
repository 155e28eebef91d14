#!/bin/sh
# Writes the C source that carries the kernels inside the program (src/opencl/kernel_sources.h declares it). Each file
# becomes an array of bytes, for C99 promises no string of more than 4095 characters.
# Usage: kernels/embed.sh kernels/FILE...
set -eu

array_of() { echo "$1" | tr ./ __; }

echo '/* Made by kernels/embed.sh. */'
echo '#include "opencl/kernel_sources.h"'
for file in "$@"; do
    echo "static const unsigned char $(array_of "$file")[] = {"
    od -An -v -tu1 "$file" | sed 's/  */ /g; s/\([0-9]\) /\1, /g; s/$/,/'
    echo '0};'
done

echo 'const KernelSource kernel_sources[] = {'
for file in "$@"; do
    echo "    {\"${file#kernels/}\", (const char *)$(array_of "$file"), sizeof $(array_of "$file") - 1},"
done
echo '};'
echo "const int kernel_source_count = $#;"
