// What the view in space shows: the scene, the rays as far as the step goes, its own bold, earlier ones thin, later
// ones hidden; on demand the faces that the step tested. Without WebGL2 the program's own drawing stands in.
'use strict';

const LINE_NUMBERS = 14;
const PRIMARY = 0;
const REFLECTED = 1;
const SHADOW = 2;
const BLOCKED = 3;
const NORMAL = 4; // WalkthroughLineKind
const hex = colour => [1, 3, 5].map(k => parseInt(colour.slice(k, k + 2), 16) / 255);
const LINE_STYLES = [
    // the colours of walkthrough_svg.c
    {colour: hex('#1f5fa8'), width: 4},
    {colour: hex('#b5449a'), width: 4, dash: 26},
    {colour: hex('#c98a00'), width: 2.5},
    {colour: hex('#c0392b'), width: 2.5, dash: 8},
    {colour: hex('#3a9a5b'), width: 3},
];

let view = null;
let marks = [];

function linesOfPixel() {
    const found = [];
    const l = page.lines || [];
    const hits = page.walk ? page.walk.hits.length : 0;
    for (let k = 0; k < l.length; k += LINE_NUMBERS) {
        const leaves = l[k + 13] > 0;
        found.push({
            kind: l[k],
            from: [...l.subarray(k + 1, k + 4)],
            to: [...l.subarray(k + 4, k + 7)],
            stop: [...l.subarray(k + 7, k + 10)],
            hit: leaves ? hits + 1 : l[k + 10],
            light: l[k + 11],
            leaves,
        });
    }
    return found.filter(line => line.kind <= NORMAL);
}

// Whether a step speaks of a line.
function isOf(step, line) {
    const ray = line.kind === PRIMARY || line.kind === REFLECTED;
    switch (step.kind) {
        case 'primary':
            return ray && line.hit === 1;
        case 'nearest':
            return (ray || line.kind === NORMAL) && line.hit === step.hit;
        case 'light':
            return (
                (line.kind === SHADOW || line.kind === BLOCKED) &&
                line.hit === step.hit &&
                line.light === step.light
            );
        case 'adds':
            return (line.kind === SHADOW || line.kind === BLOCKED) && line.hit === step.hit;
        case 'mirror':
            return (ray && line.hit === step.hit + 1) || (line.kind === NORMAL && line.hit === step.hit);
        default:
            return ray;
    }
}

// 2: bold, 1: thin, 0: hidden
function weightOf(line) {
    if (!page.step) return 2;
    const steps = page.walk.steps.slice(0, page.step);
    return isOf(steps[steps.length - 1], line) ? 2 : steps.some(step => isOf(step, line)) ? 1 : 0;
}

function sceneLines() {
    const grey = matchMedia('(prefers-color-scheme: dark)').matches ? [0.42, 0.45, 0.5] : [0.55, 0.58, 0.62];
    const frame = hex('#8a5a2b');
    const lines =
        view.outline.length > 60000
            ? []
            : view.outline.map(([from, to]) => ({from, to, colour: grey, width: 1}));
    view.corners.forEach((corner, k) => {
        lines.push({from: corner, to: view.corners[(k + 1) % 4], colour: frame, width: 2});
        lines.push({from: view.camera, to: corner, colour: frame, width: 1, dash: 6});
    });
    return lines;
}

function rayLines(line) {
    const weight = weightOf(line);
    const style = LINE_STYLES[line.kind];
    if (!weight) return [];
    const thick = {...style, width: weight === 2 ? style.width : 1.2};
    if (line.kind !== BLOCKED) return [{from: line.from, to: line.to, ...thick}];
    return [
        {from: line.from, to: line.stop, ...thick, dash: 0},
        {from: line.stop, to: line.to, ...thick, width: 1.2},
    ];
}

function showRays() {
    if (!view) return showPlans();
    const lines = linesOfPixel();
    marks = lines
        .filter(line => line.kind <= REFLECTED && !line.leaves && weightOf(line))
        .map(line => ({at: line.to, text: 'P' + line.hit, kind: 'of-hit'}));
    marks.push(
        {at: view.camera, text: 'C', kind: ''},
        ...view.lights.slice(0, 12).map((at, k) => ({at, text: 'light ' + k, kind: 'of-light'})),
    );
    view.showLines([...sceneLines(), ...lines.flatMap(rayLines), ...nodeLines()]);
}

function showPlans() {
    if (!page.pixel) return;
    const svg = page.tracer.trace(...page.pixel, 'svg');
    $('plans').replaceChildren(
        element('img', {
            src: 'data:image/svg+xml,' + encodeURIComponent(svg),
            alt: 'two plans of the scene and the path',
        }),
    );
}

// The ray of the step, or else the primary ray.
function lookAlongRay() {
    const lines = linesOfPixel();
    const step = page.walk && page.walk.steps[page.step - 1];
    const line = lines.find(line => step && line.kind !== NORMAL && isOf(step, line)) || lines[0];
    if (view && line) view.lookFrom(line.from, line.kind === BLOCKED ? line.stop : line.to);
}

function watchPointer(canvas) {
    const fingers = new Map();
    canvas.addEventListener('pointerdown', event => {
        canvas.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, event);
    });
    for (const end of ['pointerup', 'pointercancel'])
        canvas.addEventListener(end, event => fingers.delete(event.pointerId));
    canvas.addEventListener('pointermove', event => {
        const before = fingers.get(event.pointerId);
        if (!before) return;
        const dx = event.clientX - before.clientX;
        const dy = event.clientY - before.clientY;
        const other = [...fingers.values()].find(finger => finger.pointerId !== event.pointerId);
        fingers.set(event.pointerId, event);
        if (other) {
            const apart = finger => Math.hypot(finger.clientX - other.clientX, finger.clientY - other.clientY);
            view.zoom(apart(before) / (apart(event) || 1));
        } else if (event.buttons & 2 || event.shiftKey) view.pan(dx, dy);
        else view.move(dx * 0.008, dy * 0.008);
    });
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener(
        'wheel',
        event => {
            event.preventDefault();
            view.zoom(Math.exp(event.deltaY * 0.001));
        },
        {passive: false},
    );
    canvas.addEventListener('dblclick', event => {
        const box = canvas.getBoundingClientRect();
        const point = view.pick(event.clientX - box.left, event.clientY - box.top);
        if (point) view.centreOn(point);
    });
    canvas.addEventListener('keydown', event => {
        const act = {
            ArrowLeft: () => view.move(-0.1, 0),
            ArrowRight: () => view.move(0.1, 0),
            ArrowUp: () => view.move(0, 0.1),
            ArrowDown: () => view.move(0, -0.1),
            '+': () => view.zoom(0.85),
            '-': () => view.zoom(1.18),
        }[event.key];
        if (!act) return;
        event.preventDefault();
        event.stopPropagation();
        act();
    });
}

function startView() {
    try {
        view = new View3D($('space'), (rows, near) => placeLabels($('labels'), marks, rows, near));
    } catch (error) {
        $('space-part').classList.add('without');
        $('space-note').textContent = error.message;
        return;
    }
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const dress = () => {
        view.background = dark.matches ? [0.11, 0.12, 0.14] : [0.98, 0.98, 0.98];
        view.draw();
    };
    dark.addEventListener('change', () => {
        dress();
        showRays();
    });
    dress();
    watchPointer($('space'));
    new ResizeObserver(() => view.draw()).observe($('space'));
    let shown = 0;
    on('picture', () => {
        if (document.body.dataset.state !== 'done' && performance.now() - shown < 200) return;
        shown = performance.now();
        view.showPicture($('picture'));
    });
}

on('scene', () => {
    if (view) view.showScene(page.tracer.faces(), page.tracer.places(), page.tracer.seen());
    page.lines = page.walk = null;
    showRays();
});
for (const event of ['pixel', 'step']) on(event, showRays);
$('along').addEventListener('click', lookAlongRay);
$('from-camera').addEventListener('click', () => view && view.lookFrom(view.camera, view.lookAt));
$('whole').addEventListener('click', () => {
    if (view) {
        view.whole();
        view.draw();
    }
});
