//! Format 2: a flow, and the tables of the models that solve it. What a case of format 1 states, its conversion states.

use bedload::case::{Case, shipped};
use bedload::model::Problem;

use crate::support::REGISTRY;

fn converted(case: &Case) -> String {
    REGISTRY.converted(case).unwrap()
}

fn parsed(name: &str, text: &str, set: &[String]) -> (Case, Problem) {
    let read = REGISTRY.parse(name, "scene.toml", text.to_owned(), set);
    read.unwrap_or_else(|error| panic!("{name}: {}\n{text}", error.render(false)))
}

#[test]
fn the_conversion_of_a_case_is_the_same_problem_to_the_bit() {
    for name in shipped::names() {
        let (case, problem) = REGISTRY.load(name, &[]).unwrap();
        let text = converted(&case);
        let (second, same) = parsed(name, &text, &[]);
        assert_eq!(format!("{:?}", problem.solver()), format!("{:?}", same.solver()), "{name}");
        assert_eq!((problem.kind, problem.stochastic), (same.kind, same.stochastic), "{name}");
        assert_eq!(problem.scene, same.scene, "{name}");
        assert_eq!((case.checks(), case.limit()), (second.checks(), second.limit()), "{name}");
        // The resolved case is the conversion, and so is the resolved case of that.
        assert_eq!(second.resolved(), text, "{name}");
        assert_eq!(converted(&second), text, "{name}");
    }
}
