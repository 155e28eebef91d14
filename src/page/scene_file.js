// The scene: chosen, edited. While one types, the program's own message stands below, with its caret.
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
    setTracer();
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

// The scene as the page came with it.
function restore() {
    page.files.set(normalPath(page.path), page.shipped.get(normalPath(page.path)));
    openScene(page.path, {keep: true, step: page.step});
    $('source').value = decode(fileOf(page.path));
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

$('scene').addEventListener('change', () => openScene($('scene').value));
$('source').addEventListener('input', edited);
$('restore').addEventListener('click', restore);
$('message').addEventListener('click', goToMistake);
$('size').addEventListener('change', () => setSize($('size').value));
$('grid').addEventListener('change', () => setGrid(Number($('grid').value)));
