//! Where an output really goes: a path is resolved before what stands there is checked.

use std::ffi::OsStr;
use std::path::{Component, Path, PathBuf};
use std::{env, fs, io};

use super::error::OutputError;

/// The folder of the run or study that is called `name`, below `runs`.
#[must_use]
pub fn default_folder(name: &str) -> PathBuf {
    // The stem of a case file is any text: `...toml` has the stem `..`, which would lead out of `runs`.
    let mut plain: String = name.chars().map(|c| if matches!(c, '/' | '\\' | '\0') { '_' } else { c }).collect();
    if plain.chars().all(|c| c == '.') {
        plain = "case".into();
    }
    Path::new("runs").join(plain)
}

/// The place that `typed` leads to, free of links and `..`: physically as far as it exists, by its names beyond. Relative to
/// the current folder if it was typed so and lies in it; nothing is made.
///
/// # Errors
/// [`OutputError::Unwritable`] if nothing can be at that place.
pub(super) fn resolve(typed: &Path) -> Result<PathBuf, OutputError> {
    let refused = |error: io::Error| OutputError::Unwritable { path: typed.into(), error };
    if typed.as_os_str().is_empty() {
        return Err(refused(io::Error::new(io::ErrorKind::InvalidInput, "the path is empty")));
    }
    let here = env::current_dir().map_err(refused)?;
    let mut found = if typed.is_absolute() { PathBuf::new() } else { here.clone() };
    let mut missing: Vec<&OsStr> = Vec::new();
    let mut components = typed.components().peekable();
    while let Some(component) = components.next() {
        match component {
            Component::Prefix(_) | Component::RootDir => found.push(component),
            Component::CurDir => {}
            Component::ParentDir => {
                if missing.pop().is_none() {
                    if !found.is_dir() {
                        return Err(refused(io::ErrorKind::NotADirectory.into()));
                    }
                    found.pop();
                }
            }
            Component::Normal(name) if !missing.is_empty() => missing.push(name),
            Component::Normal(name) => {
                let next = found.join(name);
                match fs::symlink_metadata(&next) {
                    Err(error) if error.kind() == io::ErrorKind::NotFound => missing.push(name),
                    Err(error) => return Err(refused(error)),
                    Ok(known) if !known.is_symlink() => found = next,
                    Ok(_) => match fs::canonicalize(&next) {
                        Ok(place) => found = place,
                        // A link to nowhere is no place; as the last name it is taken as what it is.
                        Err(_) if components.peek().is_none() => found = next,
                        Err(error) => return Err(refused(error)),
                    },
                }
            }
        }
    }
    found.extend(missing);
    let inside = found.strip_prefix(&here).ok().filter(|rest| !typed.is_absolute() && !rest.as_os_str().is_empty());
    Ok(inside.map(Path::to_owned).unwrap_or(found))
}

/// Folders that this process made. Dropped, it takes back those that are empty.
#[derive(Debug, Default)]
pub(super) struct Made(Vec<PathBuf>);

impl Made {
    /// Makes the folders that are missing above `path`.
    ///
    /// # Errors
    /// What the system says; then nothing is left of them.
    pub fn above(path: &Path) -> io::Result<Self> {
        let mut made = Self::default();
        let above = path.ancestors().skip(1).take_while(|folder| !folder.as_os_str().is_empty());
        let missing: Vec<&Path> = above.take_while(|folder| !folder.is_dir()).collect();
        for folder in missing.into_iter().rev() {
            match fs::create_dir(folder) {
                Ok(()) => made.0.push(folder.to_owned()),
                // Another process was faster: it is not ours to take back.
                Err(_) if folder.is_dir() => {}
                Err(error) => return Err(error),
            }
        }
        Ok(made)
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        for folder in self.0.iter().rev() {
            let _ = fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_default_folder_is_one_name_below_runs() {
        for (name, folder) in [
            ("sheet", "runs/sheet"),
            ("a.b", "runs/a.b"),
            ("...", "runs/case"),
            ("..", "runs/case"),
            (".", "runs/case"),
            ("", "runs/case"),
            ("../up", "runs/.._up"),
            ("/etc", "runs/_etc"),
            ("..\\up", "runs/.._up"),
            ("sweep-..", "runs/sweep-.."),
        ] {
            assert_eq!(default_folder(name), Path::new(folder), "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn paths_are_resolved_physically_and_by_name() {
        let scratch = tempfile::tempdir().unwrap();
        let root = fs::canonicalize(scratch.path()).unwrap();
        let at = |path: &str| root.join(path);
        fs::create_dir_all(at("real/deep")).unwrap();
        fs::write(at("file"), "").unwrap();
        std::os::unix::fs::symlink("real/deep", at("link")).unwrap();
        std::os::unix::fs::symlink("nowhere", at("dangling")).unwrap();
        for (typed, place) in [
            ("new/../real", "real"),
            ("new/er/../../real/deep/.", "real/deep"),
            ("new/../link/x", "real/deep/x"),
            ("link/..", "real"),
            ("link/../x", "real/x"),
            ("link/new/../../y", "real/y"),
            ("new/../../..", "../.."),
            ("dangling", "dangling"),
            ("new/./x/", "new/x"),
        ] {
            let expected =
                if place == "../.." { root.parent().and_then(Path::parent).unwrap().into() } else { at(place) };
            assert_eq!(resolve(&at(typed)).unwrap(), expected, "{typed}");
        }
        for typed in ["file/x", "file/..", "file/../real", "dangling/x", "dangling/.."] {
            assert_eq!(resolve(&at(typed)).map_err(|error| error.code()), Err("unwritable"), "{typed}");
        }
        assert_eq!(resolve(Path::new("")).map_err(|error| error.code()), Err("unwritable"));
        assert_eq!(resolve(Path::new("src/new/../nothing")).unwrap(), Path::new("src/nothing"));
    }

    #[test]
    fn only_what_was_made_and_is_empty_is_taken_back() {
        let scratch = tempfile::tempdir().unwrap();
        let at = |path: &str| scratch.path().join(path);
        fs::create_dir(at("theirs")).unwrap();
        drop(Made::above(&at("theirs/a/b/c")).unwrap());
        assert!(at("theirs").is_dir() && !at("theirs/a").exists());
        let made = Made::above(&at("theirs/a/b/c")).unwrap();
        fs::write(at("theirs/a/note"), "").unwrap();
        drop(made);
        assert!(at("theirs/a/note").exists() && !at("theirs/a/b").exists());
    }
}
