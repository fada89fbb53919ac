"""usage: package_root.py FOLDER PACKAGE.deb…

Makes FOLDER a root in which the files of the given packages would run: an installed Debian of nothing
but what they depend on, taken from the packages of this machine. Its dpkg knows the dependencies
of all packages; of those of the first one it has the files, too, without documentation.
"""
import pathlib
import re
import subprocess
import sys


def stanzas(text):
    for block in text.strip().split("\n\n"):
        fields, name = {}, None
        for line in block.split("\n"):
            if line[:1].isspace():
                fields[name] += "\n" + line
            else:
                name, value = line.split(":", 1)
                fields[name] = value.strip()
        yield fields, block


def groups(fields):
    """The dependencies, each as the names of its alternatives."""
    for kind in ("Pre-Depends", "Depends"):
        for group in filter(None, re.split(r",\s*", fields.get(kind, ""))):
            yield [re.split(r"[\s:(]", name.strip())[0] for name in group.split("|")]


root = pathlib.Path(sys.argv[1])
installed, provided = {}, {}
for fields, block in stanzas(pathlib.Path("/var/lib/dpkg/status").read_text(encoding="utf-8")):
    if fields["Status"].endswith(" installed"):
        installed[fields["Package"]] = (fields, block)
        for name in re.split(r",\s*", fields.get("Provides", "")):
            provided.setdefault(name.split(" ")[0], fields["Package"])


def closure(deb, own):
    """The packages of this machine that an archive depends on, directly or not."""
    text = subprocess.run(["dpkg-deb", "-f", deb], capture_output=True, text=True, check=True).stdout
    found, open_groups = set(), list(groups(next(stanzas(text))[0]))
    while open_groups:
        group = open_groups.pop()
        if own & set(group):
            continue
        name = next((n for n in group if n in installed), None) or next(
            (provided[n] for n in group if n in provided), None)
        if name is None:
            sys.exit(f"{deb}: {' or '.join(group)} is not installed here")
        if name not in found:
            found.add(name)
            open_groups += groups(installed[name][0])
    return found


def copy(paths):
    """Symbolic links of the root, as /lib, stay."""
    made = subprocess.run(["tar", "-C", "/", "-c", "--no-recursion", "-T", "-"], check=True,
                          input="\n".join(path.lstrip("/") for path in paths).encode(), stdout=subprocess.PIPE).stdout
    subprocess.run(["tar", "-C", root, "-x", "--keep-directory-symlink"], input=made, check=True)


for folder in ("usr/bin", "usr/sbin", "usr/lib", "usr/lib64", "etc", "tmp", "var/lib/dpkg/info",
               "var/lib/dpkg/updates", "var/lib/dpkg/triggers"):
    (root / folder).mkdir(parents=True, exist_ok=True)
for folder in ("bin", "sbin", "lib", "lib64"):
    (root / folder).symlink_to(f"usr/{folder}")

debs = sys.argv[2:]
own = {pathlib.Path(deb).name.split("_")[0] for deb in debs}
with_files = closure(debs[0], own)
known = set().union(*(closure(deb, own) for deb in debs))
(root / "var/lib/dpkg/status").write_text(
    "".join(installed[name][1] + "\n\n" for name in sorted(known)), encoding="utf-8")

files = subprocess.run(["dpkg", "-L", *sorted(with_files)], capture_output=True, text=True,
                       check=True).stdout.split("\n")
needed = {path for path in files if path.startswith("/") and path != "/."
          and not path.startswith(("/usr/share/", "/usr/include/")) and pathlib.Path(path).exists()}
# What scripts of packages made when these were installed: the choice among several BLAS libraries.
links = [path for path in pathlib.Path("/usr/lib").glob("*/*.so*")
         if path.is_symlink() and str(path.readlink()).startswith("/etc/alternatives/")]
copy(sorted(needed | {str(p) for p in links} | {str(p.readlink()) for p in links}))
for path in sorted(known):
    for info in pathlib.Path("/var/lib/dpkg/info").glob(f"{path}[.:]*list"):
        (root / "var/lib/dpkg/info" / info.name).write_bytes(info.read_bytes())
print(f"a root of {len(known)} packages, {len(with_files)} of them with files")
