// The scene: chosen, edited, dropped. While one types, the program's own message stands below, with its caret.
'use strict';

const SIZE = 640; // columns, unless the link says otherwise or the scene has fewer
const decode = bytes => new TextDecoder().decode(bytes);

const scenePaths = () =>
    [...page.files.keys()].filter(name => name.endsWith('.json')).map(name => page.names.get(name) || name);
const fileOf = path => page.files.get(normalPath(path || ''));

function listScenes() {
    const chosen = page.path;
    $('scene').replaceChildren(
        ...scenePaths().map(path => element('option', {value: path}, path.replace(/^scenes\/|\.json$/g, ''))),
    );
    $('scene').value = chosen;
}

function defaultSize() {
    const columns = page.tracer.value('columns');
    const rows = page.tracer.value('rows');
    const wide = Math.max(80, Math.min(SIZE, columns));
    if (columns < 160) return [4 * columns, 4 * rows]; // a scene for a small picture still deserves one to look at
    return [wide, Math.max(1, Math.round((wide * rows) / columns))];
}

// Opens a scene of page.files. `keep`: the same picture's size and pixel, as after an edit. Returns whether it is
// valid.
function openScene(path, {size = null, pixel = null, step = 0, keep = false} = {}) {
    let message = '';
    try {
        page.tracer.open(path);
    } catch (error) {
        message = error.message;
    }
    showMessage(message);
    if (message) return false;
    const again = keep && page.path === path && page.columns;
    page.path = path;
    const [columns, rows] = size || (again ? [page.columns, page.rows] : defaultSize());
    const shown = pixel || (again ? page.pixel : null);
    Object.assign(page, {columns, rows, step, pixel: null});
    page.tracer.set({columns, rows, grid: page.grid, arithmetic: page.arithmetic});
    $('size').value = `${columns} x ${rows}`;
    $('holds').textContent =
        `${page.path}: ${page.tracer.value('faces')} faces, ${page.tracer.value('lights')} lights`;
    if (!keep) $('source').value = decode(fileOf(path));
    listScenes();
    announce('scene');
    render();
    choosePixel(...(shown || [columns >> 1, rows >> 1]));
    return true;
}

function showMessage(message) {
    const [first, ...rest] = message.split(/(?<=\n)/);
    $('message').replaceChildren(element('span', {}, first), ...rest);
    $('message').hidden = !message;
    document.body.classList.toggle('mistaken', Boolean(message));
    if (message && !page.columns) fail(message);
    else $('error').hidden = true;
}

// The message's line and column, as the cursor's place in the text.
function goToMistake() {
    const found = /:(\d+):(\d+): /.exec($('message').textContent);
    if (!found) return;
    const lines = $('source').value.split('\n');
    const line = Number(found[1]) - 1;
    const at = lines.slice(0, line).reduce((sum, text) => sum + text.length + 1, 0) + Number(found[2]) - 1;
    $('source').focus();
    $('source').setSelectionRange(at, at + 1);
}

let typing = 0;

function edited() {
    clearTimeout(typing);
    typing = setTimeout(() => {
        page.files.set(normalPath(page.path), new TextEncoder().encode($('source').value));
        openScene(page.path, {keep: true, step: page.step});
    }, 250);
}

function setSize(text) {
    const found = /^\s*(\d+)\s*[x×,]\s*(\d+)\s*$/.exec(text);
    const size = found && found.slice(1).map(Number);
    if (size && size.every(n => n >= 1 && n <= 4096)) openScene(page.path, {size, keep: true, step: page.step});
    else $('size').value = `${page.columns} x ${page.rows}`;
}

function setGrid(grid) {
    page.grid = grid;
    $('grid').value = String(grid);
    if (page.path) openScene(page.path, {keep: true, pixel: page.pixel, step: page.step});
}

// --- Files that are dropped or chosen ---

// All files of an entry, folders included: [path, File].
async function filesOf(entry, path = '') {
    if (entry.isFile) return [[path + entry.name, await new Promise((give, fail) => entry.file(give, fail))]];
    const reader = entry.createReader();
    const found = [];
    for (let part; (part = await new Promise((give, fail) => reader.readEntries(give, fail))).length;)
        found.push(...part);
    return (await Promise.all(found.map(child => filesOf(child, path + entry.name + '/')))).flat();
}

// Models without their folders are put where the scene looks for them.
function settleModels(paths) {
    for (const path of paths.filter(name => name.endsWith('.json'))) {
        const folder = path.includes('/') ? path.replace(/[^/]*$/, '') : '';
        for (const [, name] of decode(page.files.get(path)).matchAll(/"obj"\s*:\s*"([^"]+)"/g)) {
            const wanted = normalPath(folder + name);
            const last = name.replace(/.*\//, '');
            const given = paths.find(other => other.replace(/.*\//, '') === last);
            if (!page.files.has(wanted) && given) page.files.set(wanted, page.files.get(given));
            for (const library of paths.filter(other => other.endsWith('.mtl')))
                page.files.set(
                    normalPath(wanted.replace(/[^/]*$/, '') + library.replace(/.*\//, '')),
                    page.files.get(library),
                );
        }
    }
}

async function takeFiles(files) {
    const paths = [];
    for (const [path, file] of files) {
        page.files.set(normalPath(path), new Uint8Array(await file.arrayBuffer()));
        paths.push(normalPath(path));
    }
    settleModels(paths);
    const scene = paths.find(path => path.endsWith('.json'));
    openScene(scene || page.path, {keep: !scene});
}

document.addEventListener('dragover', event => event.preventDefault());
document.addEventListener('drop', async event => {
    event.preventDefault();
    const entries = [...event.dataTransfer.items].map(item => item.webkitGetAsEntry && item.webkitGetAsEntry());
    if (entries.every(Boolean) && entries.length)
        takeFiles((await Promise.all(entries.map(entry => filesOf(entry)))).flat());
    else takeFiles([...event.dataTransfer.files].map(file => [file.name, file]));
});
$('own-files').addEventListener('change', () =>
    takeFiles([...$('own-files').files].map(file => [file.name, file])),
);
$('scene').addEventListener('change', () => openScene($('scene').value));
$('source').addEventListener('input', edited);
$('message').addEventListener('click', goToMistake);
$('size').addEventListener('change', () => setSize($('size').value));
$('grid').addEventListener('change', () => setGrid(Number($('grid').value)));
