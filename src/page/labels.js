// The names of points in space: placed beside them, the more important first, and moved where they would overlap.
'use strict';

// In sixteenths of the page's letters, as are the sizes below.
const LABEL_PLACES = [
    [6, -18],
    [6, 4],
    [-6, -18],
    [-6, 4],
    [6, -36],
    [6, 22],
    [-6, -36],
    [-6, 22],
]; // negative: left of the point

const ARROWS = ['→', '↘', '↓', '↙', '←', '↖', '↑', '↗'];

// A light outside of the drawing is named at its edge, with an arrow to where it is.
function broughtIn(mark, width, height) {
    const {x, y, kind, text} = mark;
    if (kind !== 'of-light' || (x >= 0 && x <= width && y >= 0 && y <= height)) return mark;
    const dx = x - width / 2;
    const dy = y - height / 2;
    const scale = Math.min((width / 2 - 45) / Math.abs(dx || 1), (height / 2 - 20) / Math.abs(dy || 1));
    const arrow = ARROWS[(Math.round(Math.atan2(dy, dx) / (Math.PI / 4)) + 8) % 8];
    return {...mark, x: width / 2 + dx * scale, y: height / 2 + dy * scale, text: `${text} ${arrow}`, outside: true};
}

function overlaps(a, b) {
    return a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;
}

// marks: [{at, text, kind}], the most important first.
function placeLabels(holder, marks, rows, near) {
    const width = holder.clientWidth;
    const height = holder.clientHeight;
    const unit = letterSize() / 16;
    const labels = [];
    // Printed, the drawing has another size.
    const percent = (x, y) => `left: ${(100 * x) / width}%; top: ${(100 * y) / height}%`;
    const seen = marks
        .map(mark => ({...mark, p: projected(rows, mark.at)}))
        .filter(({p}) => p[3] > near)
        .map(({p, ...mark}) => ({
            ...mark,
            x: (0.5 + (0.5 * p[0]) / p[3]) * width,
            y: (0.5 - (0.5 * p[1]) / p[3]) * height,
        }))
        .map(mark => broughtIn(mark, width, height));
    const taken = seen.map(({x, y}) => ({x: x - 4, y: y - 4, w: 8, h: 8}));
    for (const {x, y, text, kind, outside} of seen) {
        if (!outside) labels.push(element('i', {class: 'dot ' + kind, style: percent(x, y)}));
        const w = (9 * text.length + 6) * unit;
        const h = 17 * unit;
        const places = LABEL_PLACES.map(([dx, dy]) => ({
            x: x + dx * unit - (dx < 0 ? w : 0),
            y: y + dy * unit,
            w,
            h,
        }));
        const place = places.find(
            box =>
                !taken.some(other => overlaps(box, other)) &&
                box.x >= 0 &&
                box.y >= 0 &&
                box.x + w <= width &&
                box.y + h <= height,
        );
        if (!place) continue;
        taken.push(place);
        labels.push(element('span', {class: 'label ' + kind, style: percent(place.x, place.y)}, text));
    }
    holder.replaceChildren(...labels);
}
