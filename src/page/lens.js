// The pixels around the cross-hair, magnified: 9 x 9 of them, and in a table their values.
'use strict';

const LENS = 9;

// Calls act(column, row, i, j) for each pixel of the lens that is in the picture.
function aroundPixel(act) {
    const half = (LENS - 1) / 2;
    for (let j = 0; j < LENS; j++)
        for (let i = 0; i < LENS; i++) {
            const column = page.pixel[0] + i - half;
            const row = page.pixel[1] + j - half;
            if (column >= 0 && row >= 0 && column < page.columns && row < page.rows) act(column, row, i, j);
        }
}

function drawLens() {
    if (!page.pixel) return;
    const canvas = $('lens');
    const context = canvas.getContext('2d');
    const cell = canvas.width / LENS;
    context.clearRect(0, 0, canvas.width, canvas.height);
    aroundPixel((column, row, i, j) => {
        context.fillStyle = `rgb(${pixelColour(column, row)})`;
        context.fillRect(i * cell, j * cell, cell, cell);
    });
    const middle = ((LENS - 1) / 2) * cell;
    for (const [colour, width] of [
        ['#000', 4],
        ['#fff', 2],
    ]) {
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.strokeRect(middle, middle, cell, cell);
    }
    tellPixel(page.pixel);
}

function tellPixel([column, row]) {
    const colour = pixelColour(column, row);
    $('lens-swatch').style.background = `rgb(${colour})`;
    $('lens-place').textContent = `column ${column}, row ${row}`;
    $('lens-value').textContent = colour.join(' ');
}

function fillValues() {
    const rows = Array.from({length: LENS}, () => element('tr'));
    aroundPixel((column, row, i, j) => {
        const colour = pixelColour(column, row);
        const dark = 0.3 * colour[0] + 0.59 * colour[1] + 0.11 * colour[2] < 120;
        const chosen = column === page.pixel[0] && row === page.pixel[1];
        rows[j].append(
            element(
                'td',
                {
                    style: `background: rgb(${colour}); color: ${dark ? '#fff' : '#000'}`,
                    class: chosen && 'chosen',
                    title: `column ${column}, row ${row}`,
                },
                ...colour.flatMap(c => [String(c), element('br')]),
            ),
        );
    });
    $('values-table').replaceChildren(...rows);
}

function showValues() {
    if (!page.pixel) return;
    fillValues();
    $('values').showModal();
}

$('lens').addEventListener('click', showValues);
$('show-values').addEventListener('click', showValues);
$('picture').addEventListener('pointermove', event => {
    const [column, row] = pixelAt(event);
    if (column >= 0 && row >= 0 && column < page.columns && row < page.rows) tellPixel([column, row]);
});
$('picture').addEventListener('pointerleave', () => page.pixel && tellPixel(page.pixel));
on('pixel', drawLens);
on('picture', drawLens);
