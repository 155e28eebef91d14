// Two pixels: one is pinned, another chosen. Shown is where their walkthroughs differ, the first difference first.
'use strict';

// A line that the program broke is one line again.
const linesOfStep = step =>
    plain(bodyOf(step))
        .replace(/\n +(?== )/g, ' ')
        .replace(/,\n +/g, ', ')
        .split('\n');
// A line's words, signs and names of faces: all but its numbers.
const withoutNumbers = line =>
    line.replace(/(\/\d+)|-?\d+(\.\d+)?(e[-+]?\d+)?/g, (all, face) => face || '#').replace(/\s+/g, '');
const keyOf = step => `${step.kind} ${step.hit} ${step.light}`;

// The lines that differ, in pairs; lines are matched by their words first, so that a line more does not shift all
// others.
function differences(one, other) {
    const a = linesOfStep(one);
    const b = linesOfStep(other);
    const pairs = [];
    const length = Array.from({length: a.length + 1}, () => new Uint16Array(b.length + 1));
    for (let i = a.length - 1; i >= 0; i--)
        for (let j = b.length - 1; j >= 0; j--)
            length[i][j] =
                withoutNumbers(a[i]) === withoutNumbers(b[j])
                    ? length[i + 1][j + 1] + 1
                    : Math.max(length[i + 1][j], length[i][j + 1]);
    for (let i = 0, j = 0; i < a.length || j < b.length;) {
        if (i < a.length && j < b.length && withoutNumbers(a[i]) === withoutNumbers(b[j])) {
            if (a[i] !== b[j]) pairs.push({one: a[i], other: b[j], words: false});
            (i++, j++);
        } else if (j >= b.length || (i < a.length && length[i + 1][j] >= length[i][j + 1]))
            pairs.push({one: a[i++], other: '', words: true});
        else pairs.push({one: '', other: b[j++], words: true});
    }
    return pairs.filter(pair => pair.one.trim() || pair.other.trim());
}

// Steps of both pixels, those that only one of them has beside nothing.
function compareWalks(one, other) {
    const others = new Map(other.steps.map(step => [keyOf(step), step]));
    const found = [];
    for (const step of one.steps) {
        const twin = others.get(keyOf(step));
        others.delete(keyOf(step));
        found.push(
            twin
                ? {title: step.title, pairs: differences(step, twin), one: step, other: twin}
                : {title: step.title, one: step, pairs: []},
        );
    }
    for (const step of others.values()) found.push({title: step.title, other: step, pairs: []});
    return found
        .filter(part => part.pairs.length || !part.one || !part.other)
        .sort((a, b) => (a.one || a.other).number - (b.one || b.other).number);
}

const partsWays = part => !part.one || !part.other || part.pairs.some(pair => pair.words);

function differenceFold(part, first) {
    const row = (name, line, words) =>
        line &&
        element('tr', {class: words && 'words'}, element('th', {scope: 'row'}, name), element('td', {}, line));
    const lines = part.pairs.map(pair =>
        element(
            'tbody',
            {},
            row(String(page.pinned.pixel), pair.one, pair.words) || '',
            row(String(page.pixel), pair.other, pair.words) || '',
        ),
    );
    const only = !part.one ? `only ${page.walk.pixel}` : !part.other ? `only ${page.pinned.walk.pixel}` : '';
    return element(
        'details',
        {class: 'step difference', open: first},
        element(
            'summary',
            {},
            part.title,
            element('span', {class: 'note'}, only ? ` ${only}` : partsWays(part) ? '' : ' numbers only'),
        ),
        element('div', {class: 'scroll'}, element('table', {}, ...lines)),
    );
}

function showDifferences() {
    $('differences-part').hidden = !page.pinned || !page.walk;
    $('pin').setAttribute('aria-pressed', String(Boolean(page.pinned)));
    const two = page.pinned && String(page.pinned.pixel) !== String(page.pixel);
    document.body.classList.toggle('comparing', Boolean(two)); // then only what differs is shown
    if (!page.pinned || !page.walk) return;
    const parts = compareWalks(page.pinned.walk, page.walk);
    const first = parts.find(partsWays);
    $('differences-title').textContent = `${page.pinned.walk.pixel} beside ${page.walk.pixel}`;
    // The program's own words: its title, where the two part, and a table of what differs.
    const [said, ...table] = page.tracer
        .diff(page.pinned.pixel, page.pixel, columnsOfText())
        .trimEnd()
        .split('\n\n');
    $('differences-first').textContent = said.split('\n').slice(1).join(' ');
    $('differences-table').textContent = table.join('\n\n');
    $('differences-table').hidden = !table.length;
    $('differences').replaceChildren(...parts.map(part => differenceFold(part, part === (first || parts[0]))));
}

function togglePin() {
    if (!page.walk) return;
    page.pinned = page.pinned ? null : {pixel: page.pixel, walk: page.walk};
    announce('pin');
}

$('pin').addEventListener('click', togglePin);
on('pixel', showDifferences);
on('pin', showDifferences);
on('scene', () => {
    page.pinned = null;
});
