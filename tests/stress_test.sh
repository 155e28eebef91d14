#!/bin/sh
# A small part of the stress suite, about a minute of it: `make stress` runs it all. The program lies beside rectray.
exec "$(dirname "$RECTRAY")/stress" --scale 0.002 2>/dev/null
