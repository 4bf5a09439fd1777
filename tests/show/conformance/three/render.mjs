#!/usr/bin/env node
// Draws models with three.js in Chromium, without a display or a network. three_test.cpp calls it.
import http from 'node:http';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';
import { spawn } from 'node:child_process';
import { fileURLToPath } from 'node:url';

const HERE = path.dirname(fileURLToPath(import.meta.url));
const MODULES = process.env.THREE_MODULES || path.join(HERE, 'node_modules');
const HELP = `usage: render.mjs MODEL.(gltf|glb|fbx|obj) OUT.png [options]
       render.mjs --batch LIST.txt        (each line: MODEL OUT [options])
  --size N | WxH          picture size (512)
  --eye x,y,z --target x,y,z --up x,y,z --fov DEG(vertical, 40)   default: looks at the whole model
  --ortho HEIGHT          orthographic, this many units high
  --near N --far N        default: from the posed bounds
  --camera N|NAME         the file's own camera
  --clip NAME|N --time T  pose of a clip at T seconds (clamped at its ends)
  --sun x,y,z,intensity   direction TO the sun; irradiance (white diffuse facing it comes out at intensity/pi)
  --sun-color r,g,b       linear
  --ambient r,g,b         diffuse only; white diffuse comes out at this value (linear)
  --env none|uniform|r,g,b   uniform environment, diffuse and specular (uniform = 1,1,1)
  --env-map FILE.hdr      equirectangular picture of the surroundings, diffuse and specular; its middle is at +x
  --no-file-lights        ignore KHR_lights_punctual lights
  --tone off|linear|aces|agx|neutral   (off)      --exposure E (1; not used when off)
  --output srgb|linear    encoding of the picture (srgb)
  --background r,g,b|none 0..1 in sRGB (0,0,0); none = transparent
  --aa 0|4                multisampling (0)
  --flat                  all white, unlit: a silhouette
  --float OUT.pfm         also linear unclamped colour
  --dump OUT.json         also node world matrices and posed world-space vertices
  --root DIR              folder the model's files may be read from (the model's own)
  --backend swiftshader|gl   (swiftshader)   --chromium PATH   --timeout S (120)   --strict (warnings fail)   --verbose`;

function parse(argv) {
  const o = { size: [512, 512], eye: null, target: null, up: [0, 1, 0], fov: 40, ortho: 0, near: null, far: null, camera: null, clip: null, time: 0,
    sun: null, sunColor: [1, 1, 1], ambient: null, env: null, envMap: null, fileLights: true, tone: 'off', exposure: 1, output: 'srgb', background: [0, 0, 0],
    aa: 0, flat: false, float: null, dump: null, root: null };
  const g = { batch: null, backend: 'swiftshader', chromium: process.env.CHROMIUM || 'chromium', timeout: 120, strict: false, verbose: false };
  const pos = [];
  for (let i = 0; i < argv.length; i++) {
    const a = argv[i];
    if (!a.startsWith('--')) { pos.push(a); continue; }
    const val = () => { if (++i >= argv.length) throw new Error(a + ' needs a value'); return argv[i]; };
    const vec = (n, s = val()) => { const v = s.split(',').map(Number); if (v.length !== n || v.some(x => !Number.isFinite(x))) throw new Error(`${a} needs ${n} numbers`); return v; };
    const num = () => vec(1)[0];
    switch (a) {
      case '--size': { const s = val().split('x').map(Number); o.size = [s[0], s[1] ?? s[0]]; break; }
      case '--eye': o.eye = vec(3); break; case '--target': o.target = vec(3); break; case '--up': o.up = vec(3); break;
      case '--fov': o.fov = num(); break; case '--ortho': o.ortho = num(); break;
      case '--near': o.near = num(); break; case '--far': o.far = num(); break;
      case '--camera': o.camera = val(); break; case '--clip': o.clip = val(); break; case '--time': o.time = num(); break;
      case '--sun': o.sun = vec(4); break; case '--sun-color': o.sunColor = vec(3); break; case '--ambient': o.ambient = vec(3); break;
      case '--env': { const s = val(); o.env = s === 'none' ? null : s === 'uniform' ? [1, 1, 1] : vec(3, s); break; }
      case '--env-map': o.envMap = val(); break;
      case '--no-file-lights': o.fileLights = false; break;
      case '--tone': o.tone = val(); break; case '--exposure': o.exposure = num(); break; case '--output': o.output = val(); break;
      case '--background': { const s = val(); o.background = s === 'none' ? null : vec(3, s); break; }
      case '--aa': o.aa = num(); break; case '--flat': o.flat = true; break;
      case '--float': o.float = val(); break; case '--dump': o.dump = val(); break; case '--root': o.root = val(); break;
      case '--batch': g.batch = val(); break; case '--backend': g.backend = val(); break; case '--chromium': g.chromium = val(); break;
      case '--timeout': g.timeout = num(); break; case '--strict': g.strict = true; break; case '--verbose': g.verbose = true; break;
      case '--help': console.log(HELP); process.exit(0);
      default: throw new Error('unknown option ' + a);
    }
  }
  return { o, g, pos };
}
function job({ o, pos }) {
  if (pos.length !== 2) throw new Error('needs MODEL and OUT.png\n' + HELP);
  const model = fs.realpathSync(pos[0]), urlOf = f => '/fs' + f.split('/').map(encodeURIComponent).join('/');
  return { ...o, model, out: pos[1], root: fs.realpathSync(o.root || path.dirname(model)), url: urlOf(model), envMap: o.envMap && urlOf(fs.realpathSync(o.envMap)) };
}
const split = s => (s.match(/"[^"]*"|\S+/g) || []).map(x => x.replace(/^"|"$/g, ''));

// ---- PNG and PFM writers (no colour profile, fixed filter: the same pixels give the same bytes)
const CRC = new Uint32Array(256).map((_, n) => { for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1; return n >>> 0; });
const crc = b => { let c = 0xffffffff; for (const x of b) c = CRC[(c ^ x) & 255] ^ (c >>> 8); return (c ^ 0xffffffff) >>> 0; };
function png(w, h, px, alpha) {
  const n = alpha ? 4 : 3, raw = Buffer.alloc(h * (1 + w * n));
  for (let y = 0; y < h; y++) for (let x = 0, s = (h - 1 - y) * w * 4, d = y * (1 + w * n) + 1; x < w; x++, s += 4, d += n) for (let k = 0; k < n; k++) raw[d + k] = px[s + k];
  const chunk = (t, d) => { const b = Buffer.alloc(12 + d.length); b.writeUInt32BE(d.length, 0); b.write(t, 4, 'latin1'); d.copy(b, 8); b.writeUInt32BE(crc(b.subarray(4, 8 + d.length)), 8 + d.length); return b; };
  const ih = Buffer.alloc(13); ih.writeUInt32BE(w, 0); ih.writeUInt32BE(h, 4); ih[8] = 8; ih[9] = alpha ? 6 : 2;
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', ih), chunk('IDAT', zlib.deflateSync(raw, { level: 6 })), chunk('IEND', Buffer.alloc(0))]);
}
function pfm(w, h, b) {
  const f = new Float32Array(b.buffer.slice(b.byteOffset, b.byteOffset + b.byteLength)), o = Buffer.alloc(w * h * 12);
  for (let i = 0; i < w * h; i++) for (let k = 0; k < 3; k++) o.writeFloatLE(f[i * 4 + k], (i * 3 + k) * 4);
  return Buffer.concat([Buffer.from(`PF\n${w} ${h}\n-1.0\n`), o]);
}

const MIME = { html: 'text/html', js: 'text/javascript', mjs: 'text/javascript', wasm: 'application/wasm', json: 'application/json', gltf: 'model/gltf+json', glb: 'model/gltf-binary',
  png: 'image/png', jpg: 'image/jpeg', jpeg: 'image/jpeg', webp: 'image/webp', avif: 'image/avif', ktx2: 'image/ktx2' };

async function main() {
  const first = parse(process.argv.slice(2)), g = first.g;
  const jobs = g.batch ? fs.readFileSync(g.batch, 'utf8').split('\n').map(s => s.trim()).filter(s => s && !s.startsWith('#')).map(s => job(parse(split(s)))) : [job(first)];
  let i = -1, bad = 0, finish; const over = new Promise(r => { finish = r; });
  let timer = null;
  const arm = () => { clearTimeout(timer); timer = setTimeout(() => { console.error(`no answer from Chromium in ${g.timeout} s`); bad++; finish(); }, g.timeout * 1000); };

  const server = http.createServer((req, res) => {
    const p = decodeURIComponent(req.url.split('?')[0]);
    const send = f => fs.readFile(f, (e, b) => { if (e) { res.writeHead(404); res.end(); return; } res.writeHead(200, { 'content-type': MIME[path.extname(f).slice(1).toLowerCase()] || 'application/octet-stream', 'cache-control': 'no-store' }); res.end(b); });
    if (p === '/next') { i++; arm(); res.writeHead(200, { 'content-type': 'application/json' }); res.end(JSON.stringify(i < jobs.length ? { ...jobs[i], model: undefined, root: undefined, out: undefined } : { done: true })); if (i >= jobs.length) setTimeout(finish, 20); return; }
    if (p === '/result') {
      const parts = []; req.on('data', d => parts.push(d)); req.on('end', () => {
        const j = jobs[i], b = Buffer.concat(parts), nl = b.indexOf(10), r = JSON.parse(b.subarray(0, nl)), h = JSON.parse(decodeURIComponent(req.headers['x-head'])); let at = nl + 1;
        const take = n => b.subarray(at, at += n);
        if (r.ok) {
          fs.writeFileSync(j.out, png(j.size[0], j.size[1], take(h.px), !j.background));
          if (j.float) fs.writeFileSync(j.float, pfm(j.size[0], j.size[1], take(h.f32)));
          if (j.dump) fs.writeFileSync(j.dump, take(h.dump));
        }
        if (!r.ok || r.glError || (g.strict && (r.notes.length || r.unsupported.length))) bad++;
        console.log(JSON.stringify({ out: j.out, ...r })); res.end();
      }); return;
    }
    if (p === '/' ) return send(path.join(HERE, 'page.html'));
    if (p === '/page.js') return send(path.join(HERE, 'page.js'));
    if (p.startsWith('/three/')) { const f = path.join(MODULES, p); if (f.startsWith(path.join(MODULES, 'three/'))) return send(f); }
    if (p.startsWith('/fs/')) { let f = null; try { f = fs.realpathSync(p.slice(3)); } catch { /* not there */ } if (f && jobs[i] && (f + '/').startsWith(jobs[i].root + '/')) return send(f); }
    if (p !== '/favicon.ico') console.error('not served: ' + p);
    res.writeHead(404); res.end();
  });
  await new Promise(r => server.listen(0, '127.0.0.1', r));
  const prof = fs.mkdtempSync(path.join(os.tmpdir(), 'refrender-'));
  const flags = ['--headless=new', `--user-data-dir=${prof}`, '--no-first-run', '--no-default-browser-check', '--disable-extensions', '--disable-component-update', '--disable-background-networking',
    '--disable-sync', '--disable-dev-shm-usage', '--force-color-profile=srgb', '--force-device-scale-factor=1', '--hide-scrollbars', '--mute-audio',
    '--disable-background-timer-throttling', '--disable-renderer-backgrounding', '--use-gl=angle',
    ...(g.backend === 'gl' ? ['--use-angle=gl-egl', '--ignore-gpu-blocklist'] : ['--use-angle=swiftshader', '--enable-unsafe-swiftshader']),
    ...(process.getuid() === 0 ? ['--no-sandbox'] : []), `http://127.0.0.1:${server.address().port}/`];
  const child = spawn(g.chromium, flags, { detached: true, stdio: ['ignore', 'ignore', g.verbose ? 'inherit' : 'ignore'], env: { ...process.env, HOME: prof } });
  child.on('error', e => { console.error('cannot start Chromium: ' + e.message); bad++; finish(); });
  child.on('exit', c => { if (i < jobs.length) { console.error('Chromium ended early, code ' + c); bad++; } finish(); });
  const stop = () => { try { process.kill(-child.pid, 'SIGKILL'); } catch { /* gone */ } };     // only the group started here
  process.on('SIGINT', () => { stop(); process.exit(130); }); process.on('SIGTERM', () => { stop(); process.exit(143); });
  arm(); await over; clearTimeout(timer);
  stop(); await new Promise(r => setTimeout(r, 50));
  fs.rmSync(prof, { recursive: true, force: true, maxRetries: 10, retryDelay: 50 });
  server.closeAllConnections?.(); server.close();
  process.exit(bad ? 1 : 0);
}
main().catch(e => { console.error(e.message); process.exit(2); });
