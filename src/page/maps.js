// Maps over the picture: what a pixel cost, or what it shows. A worker draws them when the picture is done.
'use strict';

const MAPS = {
    // name -> [MapKind of render.h, what it shows]
    rays: [0, 'rays traced for the pixel'],
    depth: [2, 'how far its ray goes: white is near'],
    normal: [3, 'N of the face that it shows'],
    face: [4, 'that face'],
    tests: [5, 'faces and nodes tested for the pixel'],
};

function chooseMap(name) {
    page.map = MAPS[name] ? name : 'picture';
    $('map-choice').value = page.map;
    $('map').hidden = true;
    $('map-note').textContent = '';
    if (page.map !== 'picture' && document.body.dataset.state !== 'rendering')
        pool.workers[0].postMessage({map: MAPS[name][0], job: pool.job});
    writeLink();
}

function showMap(data) {
    if (page.map === 'picture' || data.map !== MAPS[page.map][0]) return;
    const canvas = $('map');
    canvas.width = page.columns;
    canvas.height = page.rows;
    canvas.getContext('2d').putImageData(new ImageData(data.pixels, page.columns, page.rows), 0, 0);
    canvas.hidden = false;
    const digits = x => Number(x.toPrecision(4));
    $('map-note').textContent =
        MAPS[page.map][1] + (data.high > 0 ? `, from ${digits(data.low)} to ${digits(data.high)}` : '');
}

$('map-choice').addEventListener('change', () => chooseMap($('map-choice').value));
on('render', () => {
    $('map').hidden = true;
});
on('picture', () => {
    if (document.body.dataset.state === 'done' && page.map !== 'picture') chooseMap(page.map);
});
