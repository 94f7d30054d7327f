//! What is done again, and what is not.

use super::*;
use crate::ledger::requeue;

#[test]
fn what_was_done_before_a_restart_is_not_done_again() {
    let home = Home::new();
    home.drop("part.obj", 2);
    assert_eq!(home.once(""), summary(1, 0));
    assert_eq!(home.once(""), summary(0, 0));
    home.drop("part.obj", 3);
    home.drop("part.obj", 6);
    assert_eq!(home.once(""), summary(1, 0));
    assert_eq!(home.states(), [JobState::Done, JobState::Done]);
    assert_eq!(home.rows()[0].result, None);
}

#[test]
fn the_same_content_under_another_name_is_not_cut_again() {
    let home = Home::new();
    home.drop_plain("a.obj", 2);
    home.drop_plain("b.obj", 2);
    home.drop_plain("c/a.obj", 2);
    let both = home.once("");
    assert_eq!((both.done, both.same, both.failed), (1, 2, 0));
    let rows = home.rows();
    let holder = rows.iter().find(|row| row.result.is_some()).unwrap();
    assert!(
        rows.iter()
            .all(|row| row.state == JobState::Done && row.content == holder.content)
    );
    assert_eq!(
        rows.iter()
            .filter(|row| row.same_as == Some(holder.id))
            .count(),
        2
    );
}

#[test]
fn where_files_do_not_stay_each_name_gets_its_own_results() {
    let home = Home::new();
    for name in ["a.obj", "b.obj"] {
        home.drop_plain(name, 2);
        assert_eq!(home.once("after = 'delete'"), summary(1, 0));
    }
    home.drop_plain("a.obj", 7);
    assert_eq!(home.once("after = 'delete'"), summary(1, 0));
    let labels = |name: &str| {
        let labels = home.at(&format!("out/{name}.seamline/labels.seg"));
        fs::read_to_string(labels).unwrap().lines().count()
    };
    assert_eq!([labels("a.obj"), labels("b.obj")], [7, 2]);
    home.drop_plain("b.obj", 2);
    assert_eq!(home.once("after = 'delete'").same, 1);
}

#[test]
fn content_whose_results_were_replaced_is_cut_again_for_the_file_that_still_has_it() {
    let home = Home::new();
    home.drop_plain("a.obj", 2);
    assert_eq!(home.once(""), summary(1, 0));
    home.drop_plain("copy.obj", 2);
    assert_eq!(home.once("").same, 1);
    home.drop_plain("a.obj", 7);
    let running = home.start();
    wait_until(|| home.has_result("copy.obj"));
    assert_eq!(running.stop(), summary(2, 0));
}

#[test]
fn a_file_that_was_put_back_to_an_earlier_content_is_cut_again() {
    let home = Home::new();
    for faces in [2, 7, 2] {
        home.drop("part.obj", faces);
        assert_eq!(home.once(""), summary(1, 0));
        let labels = fs::read_to_string(home.at("out/part.obj.seamline/labels.seg")).unwrap();
        assert_eq!(labels.lines().count(), faces);
    }
}

#[test]
fn a_file_that_comes_again_after_its_results_were_taken_away_is_cut_again() {
    let home = Home::new();
    home.drop("part.obj", 2);
    assert_eq!(home.once(""), summary(1, 0));
    fs::remove_dir_all(home.at("out/part.obj.seamline")).unwrap();
    assert_eq!(home.once(""), summary(0, 0));
    home.drop("part.obj", 2);
    assert_eq!(home.once(""), summary(1, 0));
    assert!(home.has_result("part.obj"));
}

#[test]
fn other_settings_are_other_work() {
    let home = Home::new();
    home.drop("part.obj", 2);
    assert_eq!(home.once(""), summary(1, 0));
    assert_eq!(home.once("[output]\nwrite = ['labels']\n"), summary(1, 0));
    assert_eq!(home.once("[output]\nwrite = ['labels']\n"), summary(0, 0));
}

#[test]
fn bad_content_is_put_aside_each_time_it_comes_and_read_no_further() {
    let home = Home::new();
    for _ in 0..2 {
        home.drop_text("bad.obj", "v 0 0 0\nf 1 2 3\n");
        assert_eq!(home.once(""), summary(0, 1));
    }
    let rows = home.rows();
    assert_eq!(home.states(), [JobState::Quarantined; 2]);
    assert_eq!(rows[0].message, rows[1].message);
    assert_eq!(
        rows[1].source,
        Some(home.at("quarantine/bad-1.obj").canonicalize().unwrap())
    );
}

#[test]
fn a_job_put_back_is_done_again() {
    let home = Home::new();
    home.drop("refused.obj", REFUSED);
    home.drop("part.obj", 1);
    assert_eq!(home.once("after = 'move'"), summary(1, 1));
    let running = home.start();
    thread::sleep(Duration::from_millis(300));
    let all: Vec<_> = home.rows().iter().map(|row| row.id).collect();
    for (_, back) in requeue(&home.at("state"), Some(&all)).unwrap() {
        back.unwrap();
    }
    wait_until(|| home.states() == [JobState::Done, JobState::Quarantined]);
    // The row is there before the file is.
    wait_until(|| home.in_quarantine("refused.obj").is_some());
    assert_eq!(running.stop(), summary(1, 1));
    assert_eq!(home.rows().len(), 2);
}
