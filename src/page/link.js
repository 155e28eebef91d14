// The page's address holds scene, size, rays, arithmetic, tree, map, pixel, step and an edited scene's text, so that a
// link leads there.
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
        tree: asked.get('tree'),
        map: asked.get('map'),
        pixel: numbers('pixel', ','),
        step: Number(asked.get('step')) || 0,
        text: asked.get('text') || '',
    };
}

function writeNow() {
    const parts = [
        `scene=${encodeURIComponent(page.path).replace(/%2F/g, '/')}`,
        `size=${page.columns}x${page.rows}`,
        `grid=${page.grid || 'scene'}`,
    ];
    if (page.arithmetic) parts.push(`arithmetic=${ARITHMETICS[page.arithmetic]}`);
    if (page.tree !== 'none') parts.push(`tree=${page.tree}`);
    if (page.map !== 'picture') parts.push(`map=${page.map}`);
    if (page.pixel) parts.push(`pixel=${page.pixel}`);
    if (page.pixel && page.step) parts.push(`step=${page.step}`);
    if (packed.text) parts.push(`text=${packed.text}`);
    history.replaceState(null, '', '#' + parts.join('&'));
    written.at = performance.now();
}

// Browsers refuse addresses that change too often, as they would while an arrow key is held.
const ADDRESS_PAUSE = 400; // ms
const written = {at: -ADDRESS_PAUSE, timer: 0};

function writeLink() {
    clearTimeout(written.timer);
    const wait = written.at + ADDRESS_PAUSE - performance.now();
    if (wait > 0) written.timer = setTimeout(writeNow, wait);
    else writeNow();
}

// Puts the scene's file where the link wants it: its own text, or as the page came with it. Returns what is wrong.
async function takeText({scene, text}) {
    const path = normalPath(scene || '');
    if (!text && page.shipped.has(path)) page.files.set(path, page.shipped.get(path));
    if (!text || !path) return '';
    try {
        page.files.set(path, await unpack(text));
        if (!page.names.has(path)) page.names.set(path, scene);
        return '';
    } catch (error) {
        return error.message;
    }
}

for (const event of ['scene', 'render', 'pixel', 'step']) on(event, writeLink);
