// The scene from outside, and the rays of one pixel in it, by WebGL2. What is to be seen is told by space.js; here it
// is drawn.
'use strict';

const FACE_NUMBERS = 21; // of page.h, as are the places' and the lines' forms

class View3D extends Onlooker {
    constructor(canvas, drawn) {
        super();
        const gl = canvas.getContext('webgl2', {antialias: true, alpha: false, preserveDrawingBuffer: true});
        if (!gl) throw new Error('This browser has no WebGL2: two plans of the program stand in.');
        this.gl = gl;
        this.canvas = canvas;
        this.drawn = drawn; // called with the matrix after each drawing
        this.faces = new VertexList(gl, compileProgram(gl, FACES_VERTEX, FACES_FRAGMENT));
        this.verdicts = new VertexList(gl, compileProgram(gl, VERDICTS_VERTEX, VERDICTS_FRAGMENT));
        this.lines = new VertexList(gl, compileProgram(gl, LINES_VERTEX, LINES_FRAGMENT));
        this.screen = new VertexList(gl, compileProgram(gl, SCREEN_VERTEX, SCREEN_FRAGMENT));
        this.texture = gl.createTexture();
        this.background = [0.98, 0.98, 0.98];
        this.lines.fill([0, -1, 0, 1, 1, -1, 1, 1], {corner: 2});
    }

    // --- What is to be seen ---

    // faces, places, seen: as Tracer gives them.
    showScene(faces, places, seen) {
        const at = k => [...places.subarray(3 * k, 3 * k + 3)];
        this.list = faces;
        this.camera = at(0);
        this.lookAt = at(1);
        this.corners = [3, 4, 5, 6].map(at);
        this.lights = [];
        for (let k = 7; 3 * k < places.length; k++) this.lights.push(at(k));
        this.up = vec.unit(at(2));
        const look = vec.unit(vec.sub(this.lookAt, this.camera));
        // From the scene to the camera, level.
        this.front = vec.unit(vec.sub(vec.scale(vec.dot(look, this.up), this.up), look));
        this.side = vec.cross(this.up, this.front);
        this.measure(seen);
        this.fillFaces();
        const [a, b, c, d] = this.corners;
        this.screen.count = this.screen.fill([...a, 0, 0, ...b, 1, 0, ...d, 0, 1, ...c, 1, 1], {
            position: 3,
            at: 2,
        });
        this.whole();
    }

    face(f) {
        const at = FACE_NUMBERS * f;
        const count = this.list[at];
        return {
            count,
            object: this.list[at + 1],
            front: this.list[at + 2] > 0,
            vertices: Array.from({length: count}, (_, k) => [
                ...this.list.subarray(at + 3 + 3 * k, at + 6 + 3 * k),
            ]),
            colour: [...this.list.subarray(at + 15, at + 18)],
            normal: [...this.list.subarray(at + 18, at + 21)],
        };
    }

    // Walls and sheets are left out from behind, so that one looks into the room; solid things are drawn from all
    // sides.
    fillFaces() {
        const data = [];
        const isTurned = face => heightOver(face, this.camera) < 0;
        this.faceCount = this.list.length / FACE_NUMBERS;
        this.triangles = [];
        this.outline = [];
        const faces = Array.from({length: this.faceCount}, (_, f) => this.face(f));
        const solids = findSolids(faces, this.camera);
        for (const face of faces) {
            const cut = !solids.has(face.object) || face.front;
            const normal = isTurned(face) && !face.front && cut ? vec.scale(-1, face.normal) : face.normal;
            const colour = face.colour.map(c => 0.08 + 0.92 * c);
            for (const [a, b, c] of this.trianglesOf(face)) {
                this.triangles.push({a, b, c, normal, cut});
                for (const p of [a, b, c]) data.push(...p, ...normal, ...colour, cut ? 1 : 0);
            }
            for (let k = 0; k < face.count; k++)
                this.outline.push([face.vertices[k], face.vertices[(k + 1) % face.count]]);
        }
        this.faces.count = this.faces.fill(data, {position: 3, normal: 3, colour: 3, cut: 1});
    }

    trianglesOf({vertices: v}) {
        return v.slice(2).map((corner, k) => [v[0], v[k + 1], corner]);
    }

    // lines: [{from, to, colour, width, dash}]
    showLines(lines) {
        const data = lines.flatMap(line => [
            ...line.from,
            ...line.to,
            ...line.colour,
            line.dash || 0,
            line.width,
        ]);
        this.lines.count = this.lines.fill(data, {from: 3, to: 3, colour: 3, dash: 1, width: 1}, true);
        this.draw();
    }

    // faces: [{face, colour, hatch}]
    showVerdicts(faces) {
        const data = faces.flatMap(({face, colour, hatch}) =>
            this.trianglesOf(this.face(face))
                .flat()
                .flatMap(p => [...p, ...colour, hatch]),
        );
        this.verdicts.count = this.verdicts.fill(data, {position: 3, colour: 3, hatch: 1});
        this.draw();
    }

    showPicture(canvas) {
        const gl = this.gl;
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, canvas);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        this.pictured = true;
        this.draw();
    }

    // The point of the scene that is seen at x, y of the canvas; null where there is none.
    pick(x, y) {
        const [right, up, back] = this.frame();
        const eye = this.eye();
        const tan = Math.tan(HALF_ANGLE);
        const canvas = this.canvas;
        const across = (((2 * x) / canvas.clientWidth - 1) * tan * canvas.clientWidth) / canvas.clientHeight;
        const upward = (1 - (2 * y) / canvas.clientHeight) * tan;
        const direction = vec.sub(vec.add(vec.scale(across, right), vec.scale(upward, up)), back);
        let nearest = Infinity;
        for (const {a, b, c, normal, cut} of this.triangles) {
            if (cut && vec.dot(normal, vec.sub(eye, a)) < 0) continue;
            const t = triangleHit(eye, direction, a, b, c);
            if (t > 0 && t < nearest) nearest = t;
        }
        return nearest < Infinity ? vec.add(eye, vec.scale(nearest, direction)) : null;
    }

    draw() {
        if (!this.list) return;
        const gl = this.gl;
        const canvas = this.canvas;
        const ratio = window.devicePixelRatio || 1;
        const eye = this.eye();
        const width = Math.round(canvas.clientWidth * ratio);
        const height = Math.round(canvas.clientHeight * ratio);
        if (!width || !height) return;
        if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
        canvas.parentElement.style.setProperty('--shape', width / height);
        const near = this.distance * 0.01;
        const far = this.distance + this.size * 30;
        const rows = projection(eye, this.frame(), HALF_ANGLE, width / height, near, far);
        const matrix = [0, 1, 2, 3].flatMap(column => rows.map(row => row[column]));
        gl.viewport(0, 0, width, height);
        gl.clearColor(...this.background, 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.enable(gl.DEPTH_TEST);
        gl.disable(gl.BLEND);
        this.faces.use({matrix, onlooker: eye});
        gl.drawArrays(gl.TRIANGLES, 0, this.faces.count);
        this.lines.use({matrix, size: [width, height], ratio: (ratio * letterSize()) / 16, near});
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.lines.count);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        gl.depthMask(false);
        if (this.verdicts.count) {
            this.verdicts.use({matrix});
            gl.drawArrays(gl.TRIANGLES, 0, this.verdicts.count);
        }
        if (this.pictured) {
            gl.bindTexture(gl.TEXTURE_2D, this.texture);
            this.screen.use({matrix});
            gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
        }
        gl.depthMask(true);
        this.drawn(rows, near);
    }
}
