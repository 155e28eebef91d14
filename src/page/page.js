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
    return fileOf(asked.scene) || asked.text ? asked : {...asked, ...made};
}

// Shows what a link asks for, as far as this page has it.
async function follow(wish) {
    const wrong = await takeText(wish);
    const paths = scenePaths();
    const first = paths.includes('scenes/gallery.json') ? 'scenes/gallery.json' : paths[0];
    const path = fileOf(wish.scene) ? wish.scene : first;
    if (wish.grid) page.grid = wish.grid === 'scene' ? 0 : Number(wish.grid);
    $('grid').value = String(page.grid);
    Object.assign(page, {path: '', pixel: null}); // nothing is rendered before all is set
    setArithmetic(wish.arithmetic);
    setTree(wish.tree);
    if (!openScene(path, wish)) {
        page.path = path;
        $('source').value = decode(fileOf(path));
    }
    if (wrong) showMessage(wrong);
    chooseMap(wish.map);
    if (wish.step) play(0);
}

async function start() {
    for (const data of document.querySelectorAll('script[data-file]'))
        addFile(data.dataset.file, bytesOf(data.textContent));
    page.shipped = new Map(page.files);
    $('film-note').hidden = !page.files.has('scenes/turntable.json'); // the link is right where the page was built
    page.module = await WebAssembly.compile(await unpacked(bytesOf($('module').textContent)));
    page.tracer = await Tracer.make(page.module, page.files);
    startView();
    startWorkers();
    await follow(wishes());
}

addEventListener('hashchange', () => {
    const asked = readLink();
    if (fileOf(asked.scene) || asked.text) follow(asked);
});
start().catch(error => fail(error.message));
