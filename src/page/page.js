// The beginning: unpacks the tracer and the scenes, then opens what the link asks for.
'use strict';

const bytesOf = base64 => Uint8Array.from(atob(base64.trim()), c => c.charCodeAt(0));

function addFile(path, bytes) {
    page.files.set(normalPath(path), bytes);
    page.names.set(normalPath(path), path);
}

async function unpacked(bytes) {
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

// What the page was made for, if `rectray explore` made it: scene, size, grid, pixel.
function wishes() {
    const made = JSON.parse($('wishes').textContent.trim() || '{}');
    const asked = readLink();
    return fileOf(asked.scene) ? asked : {...asked, ...made};
}

async function start() {
    for (const data of document.querySelectorAll('script[data-file]'))
        addFile(data.dataset.file, bytesOf(data.textContent));
    page.module = await WebAssembly.compile(await unpacked(bytesOf($('module').textContent)));
    page.tracer = await Tracer.make(page.module, page.files);
    startView();
    startWorkers();
    const wish = wishes();
    const first = scenePaths();
    if (wish.grid) page.grid = wish.grid === 'scene' ? 0 : Number(wish.grid);
    $('grid').value = String(page.grid);
    if (wish.arithmetic) setArithmetic(wish.arithmetic);
    const path = fileOf(wish.scene)
        ? wish.scene
        : first.includes('scenes/gallery.json')
          ? 'scenes/gallery.json'
          : first[0];
    if (!openScene(path, wish)) $('source').value = decode(fileOf(path));
    if (wish.map) chooseMap(wish.map);
    if (wish.step) play(0);
}

addEventListener('hashchange', () => {
    const asked = readLink();
    if (fileOf(asked.scene)) openScene(asked.scene, asked);
});
start().catch(error => fail(error.message));
