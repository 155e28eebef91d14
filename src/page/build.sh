#!/bin/sh
# Puts the page together. The same inputs give the same bytes.
# Usage: src/page/build.sh template MODULE.wasm ALGORITHM.md    the page without scenes
#        src/page/build.sh fill TEMPLATE SCENES_AND_MODELS...   the whole page
#        src/page/build.sh embed [TEMPLATE]                     C source that carries the template in the program
set -eu

here=src/page

# In the order in which they run.
scripts="tracer worker state packed link picture maps lens answer arithmetic steps compare algorithm matrix shaders
    solids onlooker view3d labels space tested nodes scene_file dropped handout keys page"

# A line "@NAME@" of page.html becomes what the case prints.
template()
{
    while IFS= read -r line; do
        case $line in
            @STYLE@) cat $here/page.css ;;
            @MODULE@) gzip -9n <"$1" | base64 -w0 ;;
            @ALGORITHM@) base64 -w0 <"$2" ;;
            @DRAWINGS@)
                for file in docs/images/algorithm-*.svg; do
                    printf '<script type="text/plain" data-image="%s">' "${file##*/}"
                    base64 -w0 <"$file"
                    echo '</script>'
                done ;;
            @SCRIPTS@)
                for name in $scripts; do
                    printf '<script id="source-%s">\n' "$name"
                    cat "$here/$name.js"
                    echo '</script>'
                done ;;
            *) printf '%s\n' "$line" ;;
        esac
    done <$here/page.html
}

# Each file goes where the template says @FILES@, as base64: it may hold any bytes. explore.c does the same.
fill()
{
    page=$1
    shift
    while IFS= read -r line; do
        if [ "$line" != @FILES@ ]; then
            printf '%s\n' "$line"
            continue
        fi
        echo '<script type="application/json" id="wishes">{}</script>'
        for file in "$@"; do
            printf '<script type="application/octet-stream" data-file="%s">' "$file"
            base64 -w0 <"$file"
            echo '</script>'
        done
    done <"$page"
}

embed()
{
    echo '/* Made by src/page/build.sh. */'
    echo '#include "page/explore.h"'
    if [ $# -eq 0 ]; then
        echo 'const char *const page_template = 0;'
        echo 'const long page_template_length = 0;'
        return
    fi
    echo 'static const unsigned char bytes[] = {'
    od -An -v -tu1 "$1" | sed 's/  */ /g; s/\([0-9]\) /\1, /g; s/$/,/'
    echo '0};'
    echo 'const char *const page_template = (const char *)bytes;'
    echo 'const long page_template_length = sizeof bytes - 1;'
}

"$@"
