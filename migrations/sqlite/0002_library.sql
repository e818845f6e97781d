-- What users add to the library, and the networks that trainings make: immutable versions of a name.

CREATE TABLE library_entry (
    seq        INTEGER PRIMARY KEY,
    kind       TEXT    NOT NULL CHECK (kind IN ('material', 'polar', 'network', 'dataset')),
    name       TEXT    NOT NULL,
    version    INTEGER NOT NULL CHECK (version >= 1),
    hash       TEXT    NOT NULL,              -- of the content: the same again is the same version
    created_us INTEGER NOT NULL,
    job        TEXT    NOT NULL DEFAULT '',   -- id of the training that made it
    head       TEXT    NOT NULL,              -- what lists show
    UNIQUE (kind, name, version),
    UNIQUE (kind, name, hash)
) STRICT;

-- Versions that were taken, so that a deleted one never comes back as another content.
CREATE TABLE library_name (
    kind    TEXT    NOT NULL,
    name    TEXT    NOT NULL,
    newest  INTEGER NOT NULL,
    PRIMARY KEY (kind, name)
) STRICT, WITHOUT ROWID;

-- The entry itself; apart so that lists read narrow rows.
CREATE TABLE library_data (
    entry INTEGER PRIMARY KEY REFERENCES library_entry (seq) ON DELETE CASCADE,
    data  BLOB    NOT NULL
) STRICT;
