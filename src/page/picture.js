// The picture, from several workers: first one pixel of each block of 8 x 8, then all, band by band from the top.
'use strict';

const COARSE = {step: 8, band: 48};
const FINE = {step: 1, band: 6};
const pool = {workers: [], bands: [], job: 0, finished: 0, total: 0, start: 0, fine: null};

function startWorkers() {
    const source = ['tracer', 'worker'].map(name => $('source-' + name).textContent).join('\n');
    const url = URL.createObjectURL(new Blob([source], {type: 'text/javascript'}));
    const count = Math.max(1, Math.min(8, navigator.hardwareConcurrency || 2));
    for (let k = 0; k < count; k++) {
        const worker = new Worker(url);
        worker.onmessage = ({data}) => take(worker, data);
        worker.onerror = event => fail(event.message || 'a worker of this page does not start');
        pool.workers.push(worker);
    }
}

function bandsOf({step, band}) {
    const bands = [];
    for (let first = 0; first < page.rows; first += band)
        bands.push({first, count: Math.min(band, page.rows - first), step});
    return bands;
}

// Renders anew. Answers to older jobs are dropped.
function render() {
    const canvas = $('picture');
    pool.job++;
    pool.bands = [...bandsOf(COARSE), ...bandsOf(FINE)];
    Object.assign(pool, {
        total: pool.bands.length,
        finished: 0,
        start: performance.now(),
        fine: new Uint8Array(page.rows),
    });
    canvas.width = page.columns;
    canvas.height = page.rows;
    document.body.style.setProperty('--shape', page.columns / page.rows);
    document.body.dataset.state = 'rendering';
    $('status').textContent = 'rendering';
    const set = {grid: page.grid, arithmetic: page.arithmetic};
    for (const worker of pool.workers)
        worker.postMessage({
            open: page.path,
            files: [...page.files],
            module: page.module,
            job: pool.job,
            columns: page.columns,
            rows: page.rows,
            ...set,
        }); // each answers, and is then given a band
    announce('render');
}

function take(worker, data) {
    if (data.job !== pool.job) return;
    if (data.failed) return fail(data.failed);
    if (data.map !== undefined) return showMap(data);
    if (data.pixels) place(data);
    const band = pool.bands.shift();
    if (band) worker.postMessage({...band, job: pool.job});
}

function place(data) {
    const image = new ImageData(data.pixels, page.columns, data.count);
    const context = $('picture').getContext('2d', {willReadFrequently: true});
    for (let row = 0; row < data.count; row++)
        // a coarse row may come after its fine one, from another worker
        if (data.step === FINE.step || !pool.fine[data.first + row])
            context.putImageData(image, 0, data.first, 0, row, page.columns, 1);
    if (data.step === FINE.step) pool.fine.fill(1, data.first, data.first + data.count);
    pool.finished++;
    $('progress').value = pool.finished / pool.total;
    if (pool.finished === pool.total) {
        pool.ms = performance.now() - pool.start;
        document.body.dataset.state = 'done';
        $('status').textContent = `${page.columns} x ${page.rows} in ${(pool.ms / 1000).toFixed(2)} s`;
    }
    announce('picture');
}

// [red, green, blue] of a pixel as rendered.
function pixelColour(column, row) {
    return [
        ...$('picture').getContext('2d', {willReadFrequently: true}).getImageData(column, row, 1, 1).data,
    ].slice(0, 3);
}

// --- The cross-hair ---

function pixelAt(event) {
    const box = $('picture').getBoundingClientRect();
    return [
        Math.floor(((event.clientX - box.left) / box.width) * page.columns),
        Math.floor(((event.clientY - box.top) / box.height) * page.rows),
    ];
}

function placeMarks() {
    for (const [mark, pixel] of [
        ['cross', page.pixel],
        ['pinned', page.pinned && page.pinned.pixel],
    ]) {
        $(mark).hidden = !pixel;
        if (!pixel) continue;
        $(mark).style.left = ((pixel[0] + 0.5) / page.columns) * 100 + '%';
        $(mark).style.top = ((pixel[1] + 0.5) / page.rows) * 100 + '%';
    }
}

$('picture').addEventListener('click', event => choosePixel(...pixelAt(event)));
for (const event of ['render', 'pixel', 'pin']) on(event, placeMarks);
