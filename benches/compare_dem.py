#!/usr/bin/env python3
"""The same dense bed in bedload, LAMMPS and YADE, one after the other and again: ratios of work per CPU second.

    benches/compare_dem.py [--bed FILE] [--copies 1 5] [--repeats 3] [--bench BINARY]

Needs `lmp` (gran/hooke/history) and `yade` from the Debian packages; a peer that is not installed is named and left out.
Facts: d = 6 mm, k_n = 5e3, k_s = 2.5e3 N/m, mu = 0.4, gamma_n = 2562 1/s on the reduced mass, dt = 1.8e-5 s, 660 fixed grains.
YADE has no drag and no push here (its engines for them would cost it more), so its bed only settles: the contacts are as many.
"""
import argparse, csv, glob, gzip, os, re, resource, shutil, subprocess, sys, tempfile

LX, LY, D, RHO, DT = 0.18, 0.132, 6e-3, 2500.0, 1.8e-5
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

LAMMPS = """
units si
atom_style sphere
atom_modify map array
boundary p p f
newton off
comm_modify mode single vel yes
read_data {data}
group fixed id <= {fixed}
group mobile subtract all fixed
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes exclude group fixed fixed
pair_style gran/hooke/history 5e3 2.5e3 2562 0 0.4 0
pair_coeff * *
timestep {dt}
region top block INF INF INF INF 0.06363283 INF
fix move mobile nve/sphere
fix weight mobile gravity 9.81 vector 0 0 -1
fix push mobile addforce 3.05e-3 0 0 region top
fix drag mobile viscous 2.774e-3
thermo 100000
run {warm}
{work}
"""

YADE = """
import time
from yade import pack
O.periodic = True
O.cell.setBox({lx}, {ly}, 1.0)
m = 4.0/3.0*3.141592653589793*(0.5*{d})**3*{rho}
O.materials.append(ViscElMat(kn=2*5e3, ks=2*2.5e3, cn=2*2562*0.5*m, cs=0, frictionAngle=atan(0.4), density={rho}))
for line in open('{data}'):
    f = line.split()
    x, v, w = ([float(a) for a in f[k:k+3]] for k in (1, 4, 7))
    b = O.bodies[O.bodies.append(sphere(x, 0.5*{d}, fixed=int(f[0]) <= {fixed}))]
    if int(f[0]) > {fixed}:
        b.state.vel, b.state.angVel = x and v, w
O.engines = [ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.15*0.5*{d}, allowBiggerThanPeriod=True),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_ViscElMat_ViscElMat_ViscElPhys()], [Law2_ScGeom_ViscElPhys_Basic()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.81))]
O.dt = {dt}
O.run({warm}, True)
wall, cpu = time.time(), time.process_time()
O.run({steps}, True)
real = sum(1 for i in O.interactions if i.isReal)
print('YADE', time.process_time() - cpu, time.time() - wall, real)
"""


def read(path):
    text = gzip.open(path, 'rt') if path.endswith('.gz') else open(path)
    rows = list(csv.reader(l for l in text if not l.startswith('#')))[1:]
    return [[float(f) for f in row] for row in rows]


def spread(rows, copies):
    """The bed `copies` times along x, in the order of the bench: each grain with its copies."""
    return [[row[0], row[1] + k * LX] + row[2:] for row in rows for k in range(copies)]


def lammps_data(path, grains, copies):
    with open(path, 'w') as f:
        f.write(f'bed\n\n{len(grains)} atoms\n1 atom types\n0 {copies * LX!r} xlo xhi\n0 {LY} ylo yhi\n-0.01 0.4 zlo zhi\n\nAtoms # sphere\n\n')
        for n, g in enumerate(grains, 1):
            f.write(f'{n} 1 {D} {RHO} {g[1]!r} {g[2]!r} {g[3]!r}\n')
        f.write('\nVelocities\n\n')
        for n, g in enumerate(grains, 1):
            f.write(f'{n} ' + ' '.join(repr(x) for x in g[4:10]) + '\n')


def children():
    use = resource.getrusage(resource.RUSAGE_CHILDREN)
    return use.ru_utime + use.ru_stime


def run(command, **more):
    before = children()
    done = subprocess.run(command, capture_output=True, text=True, **more)
    if done.returncode:
        sys.exit(f'{command[0]} failed:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}')
    return done.stdout, children() - before


def lammps(folder, data, fixed, warm, steps, work=''):
    path = os.path.join(folder, 'in.lammps')
    with open(path, 'w') as f:
        f.write(LAMMPS.format(data=data, fixed=fixed, skin=0.15 * D, dt=DT, warm=warm, work=work or f'run {steps}'))
    text, _ = run(['lmp', '-in', path, '-log', 'none'], cwd=folder, env={**os.environ, 'OMP_NUM_THREADS': '1'})
    loops = re.findall(r'Loop time of (\S+) on 1 procs for (\d+) steps', text)
    share = re.findall(r'([\d.]+)% CPU use', text)
    return float(loops[-1][0]) * float(share[-1]) / 100


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument('--bed', default=os.path.join(ROOT, 'reference/dem_bed/bed_10046_spheres.csv.gz'))
    options.add_argument('--copies', type=int, nargs='+', default=[1, 5])
    options.add_argument('--repeats', type=int, default=3)
    options.add_argument('--steps', type=int, default=2000, help='of 10,046 grains; fewer with more grains')
    options.add_argument('--bench', help='the built bench; built here otherwise')
    options.add_argument('--no-yade', action='store_true')
    options = options.parse_args()
    bench = options.bench
    if not bench:
        text, _ = run(['cargo', 'build', '--release', '--bench', 'grains', '--message-format', 'short'], cwd=ROOT)
        built = glob.glob(os.path.join(ROOT, 'target/release/deps/grains-*'))
        bench = max((p for p in built if '.' not in os.path.basename(p)), key=os.path.getmtime)
    has = {name: shutil.which(name) is not None for name in ('lmp', 'yade')}
    for name in (n for n in has if not has[n]):
        print(f'{name} is not installed: left out')
    rows = read(options.bed)
    with tempfile.TemporaryDirectory() as folder:
        bed = os.path.join(folder, 'bed.csv')
        with open(bed, 'w') as f:
            f.write('id,x,y,z,u,v,w,p,q,r\n')
            f.writelines(','.join([str(int(r[0]))] + [repr(x) for x in r[1:]]) + '\n' for r in rows)
        for copies in options.copies:
            grains = spread(rows, copies)
            fixed = 660 * copies
            steps = options.steps // copies
            work = (len(grains) - fixed) * steps * 1e-6
            data = os.path.join(folder, 'bed.data')
            lammps_data(data, grains, copies)
            listed = os.path.join(folder, 'bed.txt')
            with open(listed, 'w') as f:
                f.writelines(' '.join([str(n)] + [repr(x) for x in g[1:]]) + '\n' for n, g in enumerate(grains, 1))
            if has['lmp']:
                dump = os.path.join(folder, 'lammps.dump')
                lammps(folder, data, fixed, 0, 300, f'run 300\nwrite_dump all custom {dump} id xu yu zu modify sort id format float %.17g')
                run([bench, 'trajectory', f'bed={bed}', f'copies={copies}', 'steps=300', f'out={folder}/bedload.txt'])
                theirs = [[float(x) for x in l.split()[1:]] for l in open(dump).read().splitlines()[9:]]
                ours = [[float(x) for x in l.split()] for l in open(f'{folder}/bedload.txt')]
                periods = (copies * LX, LY, 0.0)
                def off(a, b, period):
                    d = abs(a - b)
                    return min(d, abs(d - period)) if period else d
                far = max(off(a, b, p) for x, y in zip(ours, theirs) for a, b, p in zip(x, y, periods))
                print(f'{len(grains)} grains: largest difference from LAMMPS after 300 steps {far / D:.2e} d', flush=True)
            rates = {}
            for turn in range(options.repeats):
                for backend in ('avx512', 'avx2', 'scalar'):
                    text, _ = run([bench, 'speed', f'bed={bed}', f'copies={copies}', f'steps={steps}'],
                                  env={**os.environ, 'BEDLOAD_BACKEND': backend})
                    rates.setdefault(f'bedload {backend}', []).append(float(re.search(r'million_per_cpu_s (\S+)', text)[1]))
                if has['lmp']:
                    rates.setdefault('LAMMPS', []).append(work / lammps(folder, data, fixed, 300, steps))
                if has['yade'] and not options.no_yade and turn == 0:
                    few = max(steps // 10, 20)
                    script = os.path.join(folder, 'bed.py')
                    with open(script, 'w') as f:
                        f.write(YADE.format(lx=copies * LX, ly=LY, d=D, rho=RHO, dt=DT, data=listed, fixed=fixed, warm=20, steps=few))
                    text, _ = run(['yade', '-n', '-x', '-j1', script])
                    found = re.search(r'YADE (\S+) (\S+) (\d+)', text)
                    rates.setdefault('YADE', []).append(work * few / steps / float(found[1]))
                    print(f'  YADE: {int(found[3]) / (len(grains) - fixed):.2f} contacts per mobile grain')
                print('  turn', turn + 1, {k: round(v[-1], 2) for k, v in rates.items()}, flush=True)
            best = {k: max(v) for k, v in rates.items()}
            for name, rate in best.items():
                ratios = '  '.join(f'{rate / best[p]:.2f} x {p}' for p in ('LAMMPS', 'YADE') if p in best and p != name)
                print(f'{len(grains):>8} grains  {name:<16} {rate:7.2f} million particle-steps per CPU second  {ratios}')


if __name__ == '__main__':
    main()
