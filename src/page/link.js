// The page's address holds scene, size, rays, map, pixel and step, so that a link leads there.
'use strict';

function readLink() {
    const asked = new URLSearchParams(location.hash.slice(1));
    const numbers = (name, mark) =>
        /^\d+[x,]\d+$/.test(asked.get(name) || '') ? asked.get(name).split(mark).map(Number) : null;
    return {
        scene: asked.get('scene'),
        size: numbers('size', 'x'),
        grid: asked.get('grid'),
        arithmetic: asked.get('arithmetic'),
        map: asked.get('map'),
        pixel: numbers('pixel', ','),
        step: Number(asked.get('step')) || 0,
    };
}

function writeLink() {
    const parts = [
        `scene=${encodeURI(page.path)}`,
        `size=${page.columns}x${page.rows}`,
        `grid=${page.grid || 'scene'}`,
    ];
    if (page.arithmetic) parts.push(`arithmetic=${ARITHMETICS[page.arithmetic]}`);
    if (page.map !== 'picture') parts.push(`map=${page.map}`);
    if (page.pixel) parts.push(`pixel=${page.pixel}`);
    if (page.pixel && page.step) parts.push(`step=${page.step}`);
    history.replaceState(null, '', '#' + parts.join('&'));
}

for (const event of ['scene', 'render', 'pixel', 'step']) on(event, writeLink);
