-- One row a job: one file, at one path, in one state of its bytes.
CREATE TABLE jobs (
    id              INTEGER PRIMARY KEY AUTOINCREMENT,
    -- Absolute, and below its watched folder. Bytes: names need not be text.
    path            BLOB NOT NULL,
    relative        BLOB NOT NULL,
    -- Size, times and inode in which the file held still.
    stamp           TEXT NOT NULL,
    -- BLAKE3 of the bytes, once they were read.
    content         TEXT,
    -- BLAKE3 of the settings, once it was begun.
    settings        TEXT,
    state           TEXT NOT NULL CHECK (state IN ('pending', 'running', 'done', 'quarantined', 'gone')),
    -- How often it was begun.
    attempts        INTEGER NOT NULL DEFAULT 0,
    -- The program came to its end while it worked on this and others: it is to be begun alone.
    suspect         INTEGER NOT NULL DEFAULT 0,
    -- How often the program came to its end while it worked on this alone.
    crashes         INTEGER NOT NULL DEFAULT 0,
    -- Times in milliseconds since 1970.
    queued_at       INTEGER NOT NULL,
    started_at      INTEGER,
    ended_at        INTEGER,
    -- What went wrong last: where, what, and what would be right.
    stage           TEXT,
    message         TEXT,
    hint            TEXT,
    -- Are the bytes at fault, so that the same bytes fail again?
    of_content      INTEGER NOT NULL DEFAULT 0,
    -- The folder of results, for as long as no other job's results have replaced them.
    result          BLOB,
    -- Where the file was put afterwards; NULL if it is at its path, empty if it was deleted.
    source          BLOB,
    -- The job that has the results, where the same bytes were cut before.
    same_as         INTEGER REFERENCES jobs (id),
    program_version TEXT
) STRICT;

CREATE INDEX jobs_by_path ON jobs (path, id);
CREATE INDEX jobs_by_content ON jobs (content, settings);
CREATE INDEX jobs_by_state ON jobs (state, queued_at);
CREATE INDEX jobs_by_result ON jobs (result) WHERE result IS NOT NULL;
CREATE INDEX jobs_by_holder ON jobs (same_as) WHERE same_as IS NOT NULL;

PRAGMA user_version = 1;
