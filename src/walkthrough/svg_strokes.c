/* How a drawing shows each kind of line. */
#include "walkthrough/svg_strokes.h"

const SvgStroke svg_strokes[] = {
    [LINE_PRIMARY] = {"primary", "#1f5fa8", "2.4"}, [LINE_REFLECTED] = {"reflected", "#b5449a", "2.4"},
    [LINE_SHADOW] = {"shadow", "#c98a00", "1.4"},   [LINE_BLOCKED] = {"blocked", "#c0392b", "1.4;stroke-dasharray:6 5"},
    [LINE_NORMAL] = {"normal", "#3a9a5b", "1.6"},
};
